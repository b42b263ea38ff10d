// SPDX-License-Identifier: MIT
// Which pairs are drawn as quads: each lane goes over a run of pairs in order, so that their list
// is in order too, whoever comes first. First it counts them; once the counts have become places
// (pairs_place.comp) it writes them down.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/pair_wanted.glsl"

layout(constant_id = 0) const bool kWrite = false;
layout(local_size_x = 64) in;

layout(set = 1, binding = 5, scalar) buffer Chosen { uint chosen[]; };
layout(set = 1, binding = 6, scalar) buffer Runs { uint runs[]; };

const uint kRun = 64u;  // PairsPass::kRun

void main() {
  const uint run = gl_GlobalInvocationID.x;
  const uint first = run * kRun;
  if (first >= pairs.pairs) return;
  const uint least_key = counts.least_key;
  uint place = kWrite ? runs[run] : 0u;
  Tally tally = noTally();
  for (uint number = first; number < min(first + kRun, pairs.pairs); ++number) {
    if (!wanted(number, least_key, tally)) continue;
    if (kWrite) chosen[place] = number;
    ++place;
  }
  if (kWrite) return;
  runs[run] = place;
  add(tally);
}
