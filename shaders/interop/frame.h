// SPDX-License-Identifier: MIT
#ifndef SLAMSCOPE_INTEROP_FRAME_H
#define SLAMSCOPE_INTEROP_FRAME_H
#include "types.h"
SLAMSCOPE_INTEROP_BEGIN

// One eye. Positions of all glyphs are given in the first eye's coordinates ("shared"), so that
// what is uploaded is relative to the viewer. Pixels are Vulkan's here: (0, 0) is the picture's
// corner.
struct ViewData {
  mat3 R_eye_shared;
  vec3 t_eye_shared;  // m
  vec3 up_eye;        // the scene's +z
  vec2 focal;         // px
  vec2 principal;     // px
  float skew;         // px
  vec2 size;          // px
  uint background;    // 0: none, 1: pixel by pixel, 2: through the lookup map
};

struct FrameData {
  ViewData views[2];
  float near;       // m
  float border_px;  // how far the viewport reaches past the picture on each side
};

SLAMSCOPE_INTEROP_END
#endif
