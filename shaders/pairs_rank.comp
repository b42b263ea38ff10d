// SPDX-License-Identifier: MIT
// Finds the key (area or growth) that so many pairs reach or pass (PairChoice::most), exactly: keys
// are ordered as the bits of floats are, so eight bits are settled at a time. Each round counts the keys that share
// the bits settled so far by their next eight bits, then one lane goes down from the greatest.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/pairs.glsl"

layout(constant_id = 0) const uint kShift = 24u;  // of the eight bits: 24, 16, 8, 0
layout(constant_id = 1) const bool kSettle = false;
layout(local_size_x = 64) in;

layout(set = 1, binding = 4, scalar) buffer Counts { PairsCounts counts; };
layout(set = 1, binding = 7, scalar) buffer Histogram { uint histogram[]; };

void count() {
  const uint settled = counts.least_key;
  uint greatest = 0u;
  const uint first = gl_WorkGroupID.x * 64u * pairs.run + gl_LocalInvocationID.x;
  for (uint k = 0u; k < pairs.run; ++k) {
    const uint number = first + 64u * k;
    if (number >= pairs.pairs) break;
    const Pair pair = pairAt(number);
    const float area = areaOf(pair.P_d);
    if (!pair.wanted || !(area >= pairs.least_area)) continue;
    const uint key = keyOf(pair, area);
    greatest = max(greatest, key);
    const bool same = kShift == 24u || (key >> (kShift + 8u)) == (settled >> (kShift + 8u));
    if (same) atomicAdd(histogram[key >> kShift & 255u], 1u);
  }
  if (kShift == 24u && greatest > 0u) atomicMax(counts.greatest_key, greatest);
}

void settle() {
  if (gl_GlobalInvocationID.x > 0u) return;
  uint wanted = kShift == 24u ? pairs.most : counts.rank;
  uint digit = 255u;
  while (digit > 0u && histogram[digit] < wanted) {
    wanted -= histogram[digit];
    --digit;
  }
  const uint settled = kShift == 24u ? 0u : counts.least_key;
  counts.least_key = settled | digit << kShift;
  counts.rank = wanted;
  for (uint i = 0u; i < 256u; ++i) histogram[i] = 0u;
}

void main() {
  if (kSettle) {
    settle();
  } else {
    count();
  }
}
