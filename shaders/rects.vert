// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"
#include "common/quad.glsl"
#include "interop/glyphs.h"

layout(set = 1, binding = 0, scalar) readonly buffer Instances { RectGlyph rects[]; };

layout(location = 0) flat out vec4 bounds;
layout(location = 1) flat out vec4 colour;

void main() {
  const RectGlyph rect = rects[gl_InstanceIndex];
  bounds = vec4(rect.min_px, rect.max_px);
  colour = rect.colour;
  gl_Position = boxCorner(floor(rect.min_px), ceil(rect.max_px));
}
