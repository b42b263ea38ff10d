// SPDX-License-Identifier: MIT
#version 460

layout(location = 0) flat in vec4 bounds;
layout(location = 1) flat in vec4 colour;
layout(location = 0) out vec4 result;

void main() {
  const vec2 covered = max(min(gl_FragCoord.xy + 0.5, bounds.zw) - max(gl_FragCoord.xy - 0.5, bounds.xy), 0.0);
  result = vec4(colour.rgb, colour.a * covered.x * covered.y);
}
