// SPDX-License-Identifier: MIT
// Turns the counts of pairs_list.comp into places, and their sum into the arguments of the draw.
// One work group.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/pairs.glsl"

layout(local_size_x = 256) in;

layout(set = 1, binding = 4, scalar) buffer Counts { PairsCounts counts; };
layout(set = 1, binding = 6, scalar) buffer Runs { uint runs[]; };

const uint kRun = 64u;
shared uint sums[256];

void main() {
  const uint lane = gl_LocalInvocationID.x;
  const uint all = (pairs.pairs + kRun - 1u) / kRun;
  const uint share = (all + 255u) / 256u;
  const uint first = min(lane * share, all);
  const uint last = min(first + share, all);
  uint sum = 0u;
  for (uint i = first; i < last; ++i) sum += runs[i];
  sums[lane] = sum;
  barrier();
  uint place = 0u;
  for (uint i = 0u; i < lane; ++i) place += sums[i];
  for (uint i = first; i < last; ++i) {
    const uint count = runs[i];
    runs[i] = place;
    place += count;
  }
  if (lane == 255u) {
    counts.vertices = 4u;
    counts.instances = place;
    counts.first_vertex = 0u;
    counts.first_instance = 0u;
  }
}
