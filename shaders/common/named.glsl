// SPDX-License-Identifier: MIT
// Drawn to be picked from, a glyph has a name in place of its colour: its kind in the upper three
// bits, its number in the others. Nothing is blended; a pixel that it covers at least half is its own.
layout(constant_id = 2) const uint kKind = 0u;  // nameOf() in looks.hpp; 0: drawn to be looked at

vec4 colourOrName(vec4 colour, uint number) {
  if (kKind == 0u) return colour;
  return colour.a > 0.0 ? unpackUnorm4x8(kKind << 29 | number) : vec4(0.0);
}

bool covers(float coverage, vec4 colour) {
  return kKind == 0u ? coverage > 0.0 : coverage >= 0.5 && colour.a > 0.0;
}

vec4 covering(float coverage, vec4 colour) {
  return kKind == 0u ? vec4(colour.rgb, colour.a * coverage) : colour;
}
