// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_multiview : require

// The whole picture; corners of the clip volume need no clipping (see common/quad.glsl).
void main() {
  gl_Position = vec4(vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 2.0 - 1.0, 0.5, 1.0);
}
