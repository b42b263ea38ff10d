// SPDX-License-Identifier: MIT
#version 460

layout(set = 1, binding = 1) uniform sampler2DArray atlas;  // R: letter, G: halo

layout(location = 0) flat in vec2 texel_from_pixel;
layout(location = 1) flat in float halo;
layout(location = 2) flat in vec4 colour;
layout(location = 0) out vec4 result;

void main() {
  const vec2 texel = texelFetch(atlas, ivec3(floor(gl_FragCoord.xy + texel_from_pixel), 0), 0).rg;
  const float coverage = halo > 0.5 ? texel.g : texel.r;
  if (coverage <= 0.0) discard;
  result = vec4(colour.rgb, colour.a * coverage);
}
