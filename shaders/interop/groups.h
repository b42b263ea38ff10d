// SPDX-License-Identifier: MIT
// Pairs of points in groups, all of two groups summed up in three.
#ifndef SLAMSCOPE_INTEROP_GROUPS_H
#define SLAMSCOPE_INTEROP_GROUPS_H
#include "types.h"
SLAMSCOPE_INTEROP_BEGIN

struct GroupPairData {
  uint least_i, least_j;        // the points i < j of the least area
  uint greatest_i, greatest_j;  // and of the greatest
  vec3 mean;                    // xx, xy, yy of P_d, m²
};

SLAMSCOPE_INTEROP_END
#endif
