// SPDX-License-Identifier: MIT
#ifndef SLAMSCOPE_INTEROP_LENS_H
#define SLAMSCOPE_INTEROP_LENS_H
#include "types.h"
SLAMSCOPE_INTEROP_BEGIN

// Lens between the display and one eye. The display's pixel at distance r from the axis (in half
// heights) shows the picture's point at r (1 + k0 r² + k1 r⁴ + k2 r⁶) times the channel's scale.
struct LensData {
  vec2 axis;         // px, (0, 0) is the picture's corner
  float half_height; // px
  vec3 k;
  vec3 scale;        // red, green, blue
  uint plain;        // 1: the picture as it is
};

struct LensesData {
  LensData lenses[2];
};

SLAMSCOPE_INTEROP_END
#endif
