// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"
#include "common/quad.glsl"
#include "interop/glyphs.h"

layout(set = 1, binding = 0, scalar) readonly buffer Instances { LetterGlyph letters[]; };

layout(location = 0) flat out vec2 texel_from_pixel;
layout(location = 1) flat out float halo;
layout(location = 2) flat out vec4 colour;

void main() {
  const LetterGlyph letter = letters[gl_InstanceIndex];
  vec2 corner = letter.offset_px;
  if (letter.anchored != 0) {
    const vec3 anchor = eyeFromShared(letter.anchor);
    if (anchor.z < frame.near) {
      gl_Position = nowhere();
      return;
    }
    corner += pixelFromEye(anchor);
  }
  // Whole pixels: a texel is a pixel, and letters stay crisp.
  corner = floor(corner + 0.5);
  texel_from_pixel = letter.uv - (corner + letter.min_px);
  halo = float(letter.halo);
  colour = letter.colour;
  gl_Position = boxCorner(corner + letter.min_px, corner + letter.max_px);
}
