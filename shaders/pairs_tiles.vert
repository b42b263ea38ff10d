// SPDX-License-Identifier: MIT
// Quads over those tiles of the picture in which something was splatted.
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"
#include "common/pair_tiles.glsl"
#include "common/quad.glsl"

layout(set = 1, binding = 14) uniform usamplerBuffer tiles;

void main() {
  const uvec2 counts = tileCounts();
  const uint tile = uint(gl_InstanceIndex);
  if (texelFetch(tiles, int(gl_ViewIndex * counts.x * counts.y + tile)).x == 0u) {
    gl_Position = nowhere();
    return;
  }
  const vec2 corner = vec2(kTile * uvec2(tile % counts.x, tile / counts.x));
  gl_Position = boxCorner(corner, corner + float(kTile));
}
