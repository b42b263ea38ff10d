// SPDX-License-Identifier: MIT
// A box around the picture of a flat arrow: a shaft and a head, seven corners in its plane.
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"
#include "common/quad.glsl"
#include "common/named.glsl"
#include "interop/glyphs.h"

layout(set = 1, binding = 0, scalar) readonly buffer Instances { ArrowGlyph arrows[]; };

layout(location = 0) flat out vec4 shaft01;  // corners in px, in order
layout(location = 1) flat out vec4 shaft23;
layout(location = 2) flat out vec4 head01;
layout(location = 3) flat out vec2 head2;
layout(location = 4) flat out vec4 colour;

const float kShaftWidth = 0.36;  // of the head's

void main() {
  const ArrowGlyph arrow = arrows[gl_InstanceIndex];
  const float size = length(arrow.along);
  const float head = min(2.2 * length(arrow.across) / max(size, 1e-12), 0.6);  // share of the length
  const vec3 side = kShaftWidth * arrow.across;
  const vec3 neck = arrow.origin + (1.0 - head) * arrow.along;
  // The shaft reaches a little into the head, so that no seam shows.
  const vec3 shaft_end = arrow.origin + (1.0 - 0.9 * head) * arrow.along;
  const vec3 corners[7] =
      vec3[](arrow.origin - side, shaft_end - side, shaft_end + side, arrow.origin + side,
             neck - arrow.across, arrow.origin + arrow.along, neck + arrow.across);
  vec2 px[7];
  vec2 low = vec2(1e30);
  vec2 high = vec2(-1e30);
  bool in_front = true;
  for (int i = 0; i < 7; ++i) {
    const vec3 p = eyeFromShared(corners[i]);
    in_front = in_front && p.z > frame.near;
    px[i] = pixelFromEye(p);
    low = min(low, px[i]);
    high = max(high, px[i]);
  }
  if (!in_front) {
    gl_Position = nowhere();
    return;
  }
  shaft01 = vec4(px[0], px[1]);
  shaft23 = vec4(px[2], px[3]);
  head01 = vec4(px[4], px[5]);
  head2 = px[6];
  colour = colourOrName(arrow.colour, gl_InstanceIndex);
  gl_Position = boxCorner(low - 1.0, high + 1.0);
}
