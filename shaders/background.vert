// SPDX-License-Identifier: MIT
#version 460
#extension GL_ARB_shader_viewport_layer_array : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/eye.vert.glsl"
#include "common/view.glsl"

void main() {
  instanceInEye();
  // One triangle that covers the picture.
  gl_Position = vec4(vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2) * 2.0 - 1.0, 0.0, 1.0);
}
