// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/named.glsl"

layout(location = 0) flat in vec4 from_to;
layout(location = 1) flat in vec4 previous_next;
layout(location = 2) flat in float half_width;
layout(location = 3) flat in vec4 colour;
layout(location = 0) out vec4 result;

// Ends are taken as they are, so that neighbours find the very same distance to a common end.
float distanceTo(vec2 p, vec2 q) {
  const vec2 d = q - p;
  const vec2 x = gl_FragCoord.xy - p;
  const float dd = dot(d, d);
  const float t = dd > 0.0 ? dot(x, d) / dd : 0.0;
  if (t <= 0.0) return length(x);
  if (t >= 1.0) return length(gl_FragCoord.xy - q);
  return length(x - t * d);
}

void main() {
  const float own = distanceTo(from_to.xy, from_to.zw);
  const float coverage = clamp(half_width + 0.5 - own, 0.0, 1.0);
  // At a joint each pixel belongs to the nearer piece: translucent lines don't darken there.
  const bool has_previous = previous_next.xy != from_to.xy;
  const bool has_next = previous_next.zw != from_to.zw;
  const bool others = (has_previous && distanceTo(previous_next.xy, from_to.xy) <= own) ||
                      (has_next && distanceTo(from_to.zw, previous_next.zw) < own);
  if (!covers(coverage, colour) || others) discard;
  result = covering(coverage, colour);
}
