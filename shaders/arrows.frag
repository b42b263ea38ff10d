// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/coverage.glsl"
#include "common/named.glsl"

layout(constant_id = 0) const bool kLit = true;

layout(location = 0) flat in vec4 shaft01;
layout(location = 1) flat in vec4 shaft23;
layout(location = 2) flat in vec4 head01;
layout(location = 3) flat in vec2 head2;
layout(location = 4) flat in vec4 colour;
layout(location = 0) out vec4 result;

// Coverage outside of the edge from a to b, seen from the side that `turn` says.
float beyond(vec2 a, vec2 b, float turn) {
  const vec2 d = b - a;
  const vec2 n = turn * vec2(-d.y, d.x) / max(length(d), 1e-12);
  return 1.0 - halfPlaneCoverage(n, dot(n, gl_FragCoord.xy - a));
}

void main() {
  const vec2 h0 = head01.xy;
  const vec2 h1 = head01.zw;
  const vec2 e1 = h1 - h0;
  const vec2 e2 = head2 - h0;
  // The plane may be seen from below: then the corners run the other way round.
  const float turn = e1.x * e2.y - e1.y * e2.x < 0.0 ? -1.0 : 1.0;
  const float head = 1.0 - beyond(h0, h1, turn) - beyond(h1, head2, turn) - beyond(head2, h0, turn);
  const float shaft = 1.0 - beyond(shaft01.xy, shaft01.zw, turn) -
                      beyond(shaft01.zw, shaft23.xy, turn) - beyond(shaft23.xy, shaft23.zw, turn) -
                      beyond(shaft23.zw, shaft01.xy, turn);
  const float coverage = max(max(head, shaft), 0.0);
  if (!covers(coverage, colour)) discard;
  result = covering(coverage, colour);
}
