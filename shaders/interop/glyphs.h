// SPDX-License-Identifier: MIT
// What one instance of each pass is. Positions in shared coordinates (see frame.h), m.
#ifndef SLAMSCOPE_INTEROP_GLYPHS_H
#define SLAMSCOPE_INTEROP_GLYPHS_H
#include "types.h"
SLAMSCOPE_INTEROP_BEGIN

struct EllipsoidGlyph {
  vec3 centre;
  vec3 axis0, axis1, axis2;  // orthogonal semi-axes, none of length 0
  vec4 colour;
};

struct ConeGlyph {
  vec3 tip;
  vec3 axis;  // unit vector from the tip to the middle of the rim
  float height;
  float radius;
  vec4 colour;
};

struct ArrowGlyph {
  vec3 origin;
  vec3 along;   // from the origin to the point
  vec3 across;  // half the head's width
  vec4 colour;
};

// A piece of a polyline and its neighbours; previous = from or next = to at the ends.
struct SegmentGlyph {
  vec3 previous, from, to, next;
  float width_px;
  vec4 colour;
};

struct RectGlyph {
  vec2 min_px, max_px;
  vec4 colour;
};

// One letter, or its halo. Anchored ones stand relative to the picture of a point of the scene.
struct LetterGlyph {
  vec3 anchor;
  vec2 offset_px;  // of the text's corner from the anchor's picture, or from the picture's corner
  vec2 min_px, max_px;  // from the text's corner, whole
  vec2 uv;              // texel of min_px
  vec4 colour;
  uint anchored;
  uint halo;
};

SLAMSCOPE_INTEROP_END
#endif
