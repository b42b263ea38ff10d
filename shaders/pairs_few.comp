// SPDX-License-Identifier: MIT
// Which pairs are drawn as quads, where they are few: a list of them, the farthest first, and the
// arguments of their draw. One work group.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/pair_wanted.glsl"

const uint kLanes = 256u;
const uint kFewPairs = 1000u;  // as in options.hpp
layout(local_size_x = kLanes) in;

layout(set = 1, binding = 5, scalar) writeonly buffer Chosen { uint chosen[]; };

shared uint distances[kFewPairs];  // of the centres, as the bits of floats; 0: not drawn

void main() {
  const uint lane = gl_LocalInvocationID.x;
  const uint least_key = counts.least_key;
  Tally tally = noTally();
  for (uint number = lane; number < pairs.pairs; number += kLanes) {
    const bool drawn = wanted(number, least_key, tally);
    const float distance = length(solidOf(pairAt(number)).centre);
    distances[number] = drawn ? max(floatBitsToUint(distance), 1u) : 0u;
  }
  add(tally);
  barrier();
  for (uint number = lane; number < pairs.pairs; number += kLanes) {
    const uint mine = distances[number];
    uint place = 0u;
    uint all = 0u;
    for (uint other = 0u; other < pairs.pairs; ++other) {
      const uint its = distances[other];
      place += uint(its > mine || its == mine && other < number);
      all += uint(its > 0u);
    }
    if (mine > 0u) chosen[place] = number;
    if (number > 0u) continue;
    counts.vertices = 4u;
    counts.instances = all;
    counts.first_vertex = 0u;
    counts.first_instance = 0u;
  }
}
