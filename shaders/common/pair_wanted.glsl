// SPDX-License-Identifier: MIT
// Whether a pair is drawn, and what is counted of that.
uint view_index = 0u;
#define VIEW_INDEX view_index
#include "coverage.glsl"
#include "view.glsl"
#include "ellipsoid.glsl"
#include "pairs.glsl"

layout(set = 1, binding = 4, scalar) buffer Counts { PairsCounts counts; };

struct Tally {
  uint chosen, drawn, not_finite;
};
Tally noTally() { return Tally(0u, 0u, 0u); }

void add(Tally tally) {
  if (tally.chosen > 0u) atomicAdd(counts.chosen, tally.chosen);
  if (tally.drawn > 0u) atomicAdd(counts.drawn, tally.drawn);
  if (tally.not_finite > 0u) atomicAdd(counts.not_finite, tally.not_finite);
}

// least_key: counts.least_key, read once where all lanes are at work.
bool isChosen(Pair pair, uint least_key) {
  const float area = areaOf(pair.P_d);
  return pair.wanted && !(area < pairs.least_area) &&
         (pairs.most == 0u || keyOf(pair, area) >= least_key);
}

// Pixels that it may touch, from low to high; none where low > high.
struct Box {
  ivec2 low, high;
};
Box boxOf(Seen e) {
  const vec2 size = VIEW(size);
  if (!e.drawn) return Box(ivec2(1), ivec2(0));
  if (!e.in_front) return Box(ivec2(0), ivec2(size) - 1);
  const vec2 centre = e.reference + e.middle;
  const vec2 half_size = sqrt(max(vec2(e.S.x, e.S.z), 0.0));
  const vec2 low = floor(centre - half_size);
  const vec2 high = floor(centre + half_size);
  return Box(ivec2(clamp(low, vec2(0.0), size)), ivec2(clamp(high, vec2(-1.0), size - 1.0)));
}
bool empty(Box box) { return any(greaterThan(box.low, box.high)); }

Seen seenBy(uint view, Solid s) {
  view_index = view;
  const mat3 R = VIEW(R_eye_shared);
  return seen(eyeFromShared(s.centre), R * mat3(s.axis0, s.axis1, s.axis2));
}

bool wanted(uint number, uint least_key, inout Tally tally) {
  const Pair pair = pairAt(number);
  if (!isChosen(pair, least_key)) return false;
  ++tally.chosen;
  const Solid solid = solidOf(pair);
  if (!solid.finite) {
    ++tally.not_finite;
    return false;
  }
  bool in_picture = false;
  for (uint view = 0u; view < pairs.views; ++view) {
    in_picture = in_picture || !empty(boxOf(seenBy(view, solid)));
  }
  if (in_picture) ++tally.drawn;
  return in_picture;
}
