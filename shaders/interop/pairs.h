// SPDX-License-Identifier: MIT
// What the shaders of pair glyphs know: the points, how they lie, which pairs are drawn.
#ifndef SLAMSCOPE_INTEROP_PAIRS_H
#define SLAMSCOPE_INTEROP_PAIRS_H
#include "types.h"
SLAMSCOPE_INTEROP_BEGIN

struct PairsData {
  uint points;
  uint pairs;  // points (points − 1) / 2
  uint views;
  uint law;    // AxisLaw::Kind
  float gain;  // of a semi-axis, m of the scene
  float unit;  // m
  vec3 origin;      // of the points, shared coordinates
  vec3 ex, ey, ez;  // the scene's directions, shared coordinates, unit length
  float scale;      // of the points' places
  vec4 colour;
  uint conditions;   // bits kDifferentGroups …
  float least_area;  // m²
  uint most;
  uint run;  // pairs a lane
  uint most_by;  // MostBy
};

// What the device counts, and the arguments of the commands that follow.
struct PairsCounts {
  uint chosen;
  uint drawn;
  uint not_finite;
  uint large;  // splats with a large box: gone over once more, many lanes for each
  uint vertices, instances, first_vertex, first_instance;  // of the draw
  uint least_key;  // area of the smallest pair within the most, as the bits of a float
  uint rank;       // how many of the keys with its upper bits are still wanted
  uint greatest_key;  // of all pairs that were ranked
};

SLAMSCOPE_INTEROP_END
#endif
