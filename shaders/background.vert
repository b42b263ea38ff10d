// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_multiview : require

void main() {
  // One triangle that covers the picture.
  gl_Position = vec4(vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2) * 2.0 - 1.0, 0.0, 1.0);
}
