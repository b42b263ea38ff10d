// SPDX-License-Identifier: MIT
// Least, mean and greatest relative covariance between any two groups of points: a work group goes
// over all pairs of two groups, a lane over every 64th of them, and what the lanes found is put
// together in the same order whoever comes first.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/area.glsl"
#include "interop/groups.h"

layout(local_size_x = 64) in;

layout(set = 0, binding = 0) uniform samplerBuffer blocks;  // as PlanarPoints has them
// Points, group after group; before them where each group begins, and the end of the last.
layout(set = 0, binding = 1) uniform usamplerBuffer members;
layout(set = 0, binding = 2, scalar) writeonly buffer Results { GroupPairData results[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Counts { uint group_count; };

struct Found {
  vec3 sum;
  float least, greatest;
  uint least_at, greatest_at;  // which of the two groups' pairs
};
shared Found found[64];

uint beginOf(uint group) { return texelFetch(members, int(group)).x; }
uint memberAt(uint place) { return texelFetch(members, int(group_count + 1u + place)).x; }
vec4 blockAt(uint row, uint column) {
  return texelFetch(blocks, int(row * (row + 1u) / 2u + column));
}

// Equation (13) of the paper.
vec3 relativeCovariance(uint i, uint j) {
  const vec4 P_ii = blockAt(i, i);
  const vec4 P_jj = blockAt(j, j);
  const vec4 P_ji = blockAt(max(i, j), min(i, j));
  return (P_ii.xyw + P_jj.xyw) - vec3(2.0 * P_ji.x, P_ji.y + P_ji.z, 2.0 * P_ji.w);
}

// Of equal ones the first.
Found together(Found a, Found b) {
  const bool less = b.least < a.least || b.least == a.least && b.least_at < a.least_at;
  const bool more =
      b.greatest > a.greatest || b.greatest == a.greatest && b.greatest_at < a.greatest_at;
  return Found(a.sum + b.sum, less ? b.least : a.least, more ? b.greatest : a.greatest,
               less ? b.least_at : a.least_at, more ? b.greatest_at : a.greatest_at);
}

struct Groups {
  uint begin_a, begin_b, size_a, size_b;
};
// Pairs of groups are numbered as pairs of points are (pairs.glsl).
Groups groupsOf(uint number) {
  uint b = uint(0.5 + sqrt(0.25 + 2.0 * float(number)));
  if (b * (b - 1u) / 2u > number) --b;
  if (b * (b + 1u) / 2u <= number) ++b;
  const uint a = number - b * (b - 1u) / 2u;
  return Groups(beginOf(a), beginOf(b), beginOf(a + 1u) - beginOf(a), beginOf(b + 1u) - beginOf(b));
}
uvec2 pointsOf(Groups g, uint at) {
  const uint one = min(at, g.size_a * g.size_b - 1u);  // none was finite
  return uvec2(memberAt(g.begin_a + one / g.size_b), memberAt(g.begin_b + one % g.size_b));
}

void main() {
  const uint lane = gl_LocalInvocationID.x;
  const uint count = group_count * (group_count - 1u) / 2u;
  for (uint number = gl_WorkGroupID.x; number < count; number += gl_NumWorkGroups.x) {
    const Groups g = groupsOf(number);
    Found own = Found(vec3(0.0), uintBitsToFloat(0x7F800000u), -1.0, ~0u, ~0u);
    for (uint at = lane; at < g.size_a * g.size_b; at += 64u) {
      const uvec2 ij = pointsOf(g, at);
      const vec3 P_d = relativeCovariance(ij.x, ij.y);
      const float area = areaOf(P_d);
      own = together(own, Found(P_d, area, area, at, at));
    }
    found[lane] = own;
    for (uint half_count = 32u; half_count > 0u; half_count /= 2u) {
      barrier();
      if (lane < half_count) found[lane] = together(found[lane], found[lane + half_count]);
    }
    if (lane == 0u) {
      const Found all = found[0];
      const uvec2 least = pointsOf(g, all.least_at);
      const uvec2 greatest = pointsOf(g, all.greatest_at);
      results[number] =
          GroupPairData(min(least.x, least.y), max(least.x, least.y), min(greatest.x, greatest.y),
                        max(greatest.x, greatest.y), all.sum / float(g.size_a * g.size_b));
    }
    barrier();
  }
}
