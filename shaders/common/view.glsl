// SPDX-License-Identifier: MIT
// What every pass knows of the frame. `eye` (eye.vert.glsl, eye.frag.glsl) says which one is
// being drawn.
#include "../interop/frame.h"

layout(set = 0, binding = 0, scalar) uniform Frame { FrameData frame; };

#ifdef SLAMSCOPE_VERTEX
// Says into which eye's picture this vertex goes, and which glyph of the pass it belongs to.
uint instanceInEye() {
  eye = gl_InstanceIndex % int(frame.eyes);
  gl_Layer = eye;
  return uint(gl_InstanceIndex) / frame.eyes;
}
#endif

vec3 eyeFromShared(vec3 p_shared) {
  return frame.views[eye].R_eye_shared * p_shared +
         frame.views[eye].t_eye_shared;
}

// Picture of a point in front of the eye.
vec2 pixelFromEye(vec3 p_eye) {
  const vec2 xy = p_eye.xy / p_eye.z;
  const vec2 f = frame.views[eye].focal;
  return vec2(f.x * xy.x + frame.views[eye].skew * xy.y, f.y * xy.y) +
         frame.views[eye].principal;
}

// Rays through pixels have z = 1; this is how the ray moves with the pixel's u and v.
vec3 rayPerU() { return vec3(1.0 / frame.views[eye].focal.x, 0.0, 0.0); }
vec3 rayPerV() {
  const vec2 f = frame.views[eye].focal;
  return vec3(-frame.views[eye].skew / (f.x * f.y), 1.0 / f.y, 0.0);
}

// Rows of the picture's derivative, times the depth, at the point p: how the pixel moves with a
// point near p. J·p = 0, so differences of large numbers don't arise for small distant things.
struct PixelRows {
  vec3 u, v;
};
PixelRows pixelRows(vec3 p_eye) {
  const vec2 xy = p_eye.xy / p_eye.z;
  const vec2 f = frame.views[eye].focal;
  const float skew = frame.views[eye].skew;
  return PixelRows(vec3(f.x, skew, -(f.x * xy.x + skew * xy.y)), vec3(0.0, f.y, -f.y * xy.y));
}
