// SPDX-License-Identifier: MIT
// What every pass knows of the frame. VIEW_INDEX, gl_ViewIndex unless defined before, says which eye
// is being drawn.
#include "../interop/frame.h"

layout(set = 0, binding = 0, scalar) uniform Frame { FrameData frame; };

#ifndef VIEW_INDEX
#define VIEW_INDEX gl_ViewIndex
#endif
// A field of the eye's. Both are read at constant places and one is kept: software rendering
// (lavapipe 22.3) takes an index of its own for one that differs from lane to lane and gathers, which
// makes whole passes several times slower.
#define VIEW(field) (VIEW_INDEX == 0 ? frame.views[0].field : frame.views[1].field)

vec3 eyeFromShared(vec3 p_shared) {
  return VIEW(R_eye_shared) * p_shared +
         VIEW(t_eye_shared);
}

// Picture of a point in front of the eye.
vec2 pixelFromEye(vec3 p_eye) {
  const vec2 xy = p_eye.xy / p_eye.z;
  const vec2 f = VIEW(focal);
  return vec2(f.x * xy.x + VIEW(skew) * xy.y, f.y * xy.y) +
         VIEW(principal);
}

// Rays through pixels have z = 1; this is how the ray moves with the pixel's u and v.
vec3 rayPerU() { return vec3(1.0 / VIEW(focal).x, 0.0, 0.0); }
vec3 rayPerV() {
  const vec2 f = VIEW(focal);
  return vec3(-VIEW(skew) / (f.x * f.y), 1.0 / f.y, 0.0);
}

vec3 rayThrough(vec2 px) {
  const vec2 uv = px - VIEW(principal);
  return vec3(0.0, 0.0, 1.0) + uv.x * rayPerU() + uv.y * rayPerV();
}

// Rows of the picture's derivative, times the depth, at the point p: how the pixel moves with a
// point near p. J·p = 0, so differences of large numbers don't arise for small distant things.
struct PixelRows {
  vec3 u, v;
};
PixelRows pixelRows(vec3 p_eye) {
  const vec2 xy = p_eye.xy / p_eye.z;
  const vec2 f = VIEW(focal);
  const float skew = VIEW(skew);
  return PixelRows(vec3(f.x, skew, -(f.x * xy.x + skew * xy.y)), vec3(0.0, f.y, -f.y * xy.y));
}
