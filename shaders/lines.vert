// SPDX-License-Identifier: MIT
// A quad around the picture of one piece of a polyline, round ends included.
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"
#include "common/quad.glsl"
#include "common/named.glsl"
#include "interop/glyphs.h"

layout(set = 1, binding = 0, scalar) readonly buffer Instances { SegmentGlyph segments[]; };

layout(location = 0) flat out vec4 from_to;
layout(location = 1) flat out vec4 previous_next;
layout(location = 2) flat out float half_width;
layout(location = 3) flat out vec4 colour;

const float kMostWidth = 100.0;  // px

// Where the way from p (behind the eye) to q (in front) comes into sight.
vec3 clipped(vec3 p, vec3 q) {
  return p.z >= frame.near ? p : mix(p, q, (frame.near - p.z) / (q.z - p.z));
}

// The share of the way from p to q at which it enters (x) and leaves (y) the picture, widened by
// `margin`; x > y: never in it. (Liang and Barsky 1984)
vec2 shareInPicture(vec2 p, vec2 q, float margin) {
  const vec2 d = q - p;
  const vec2 low = vec2(-margin) - p;
  const vec2 high = VIEW(size) + margin - p;
  vec2 share = vec2(0.0, 1.0);
  for (int i = 0; i < 2; ++i) {
    if (abs(d[i]) < 1e-6) {
      if (low[i] > 0.0 || high[i] < 0.0) return vec2(1.0, 0.0);
      continue;
    }
    const float a = low[i] / d[i];
    const float b = high[i] / d[i];
    share = vec2(max(share.x, min(a, b)), min(share.y, max(a, b)));
  }
  return share;
}

void main() {
  const SegmentGlyph s = segments[gl_InstanceIndex];
  const vec3 from = eyeFromShared(s.from);
  const vec3 to = eyeFromShared(s.to);
  if (from.z < frame.near && to.z < frame.near) {
    gl_Position = nowhere();
    return;
  }
  const vec3 seen_from = clipped(from, to);
  const vec3 seen_to = clipped(to, from);
  const vec3 previous = from.z < frame.near ? seen_from : clipped(eyeFromShared(s.previous), from);
  const vec3 next = to.z < frame.near ? seen_to : clipped(eyeFromShared(s.next), to);

  // Lines thinner than a pixel are a pixel wide and fainter.
  half_width = 0.5 * clamp(s.width_px, 1.0, kMostWidth);
  colour = colourOrName(vec4(s.colour.rgb, s.colour.a * min(s.width_px, 1.0)), gl_InstanceIndex);

  const vec2 whole_p = pixelFromEye(seen_from);
  const vec2 whole_q = pixelFromEye(seen_to);
  const vec2 share = shareInPicture(whole_p, whole_q, half_width + 1.0);
  if (share.x > share.y) {
    gl_Position = nowhere();
    return;
  }
  // Where it is cut the joint lies outside of the picture: there is no neighbour to mind.
  const vec2 p = share.x > 0.0 ? mix(whole_p, whole_q, share.x) : whole_p;
  const vec2 q = share.y < 1.0 ? mix(whole_p, whole_q, share.y) : whole_q;
  from_to = vec4(p, q);
  previous_next = vec4(share.x > 0.0 ? p : pixelFromEye(previous),
                       share.y < 1.0 ? q : pixelFromEye(next));

  const vec2 d = q - p;
  const vec2 along = dot(d, d) > 0.0 ? normalize(d) : vec2(1.0, 0.0);
  const vec2 corner = stripCorner() * (half_width + 1.0);
  gl_Position = clipFromPixel((corner.x < 0.0 ? p : q) + corner.x * along +
                              corner.y * vec2(-along.y, along.x));
}
