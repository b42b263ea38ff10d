// SPDX-License-Identifier: MIT
// What the area of each pair was: √det of P_d to compare with from now on, and as it is now. By
// block of the covariance, so that only a change of the points' indices moves anything.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/area.glsl"

layout(constant_id = 0) const bool kLast = false;  // to compare with what was last, not first
layout(local_size_x = 64) in;

layout(set = 1, binding = 2) uniform samplerBuffer blocks;
layout(set = 1, binding = 24) uniform usamplerBuffer index_then;  // how many points, then of each the
                                                               // index it had, ~0: none
layout(set = 1, binding = 25, scalar) readonly buffer Old { vec2 old[]; };
layout(set = 1, binding = 26, scalar) writeonly buffer New { vec2 new[]; };

uint blockOf(uint row, uint column) { return row * (row + 1u) / 2u + column; }

// Neither was there, or it was no area: then this is the first.
float firstPositive(float then, float now) { return then > 0.0 && then < 1e30 ? then : now; }

void remember(uint row, uint column) {
  const vec4 P_ii = texelFetch(blocks, int(blockOf(column, column)));
  const vec4 P_jj = texelFetch(blocks, int(blockOf(row, row)));
  const vec4 P_ji = texelFetch(blocks, int(blockOf(row, column)));
  const float area =
      areaOf((P_ii.xyw + P_jj.xyw) - vec3(2.0 * P_ji.x, P_ji.y + P_ji.z, 2.0 * P_ji.w));
  const uint a = texelFetch(index_then, int(row + 1u)).x;
  const uint b = texelFetch(index_then, int(column + 1u)).x;
  vec2 was = vec2(0.0);
  if (max(a, b) != ~0u) was = old[blockOf(max(a, b), min(a, b))];
  new[blockOf(row, column)] = vec2(firstPositive(kLast ? was.y : was.x, area), area);
}

// A work group takes every so many-th row, which its lanes share.
void main() {
  const uint rows = texelFetch(index_then, 0).x;
  for (uint row = gl_WorkGroupID.x; row < rows; row += gl_NumWorkGroups.x) {
    for (uint column = gl_LocalInvocationID.x; column < row; column += 64u) remember(row, column);
  }
}
