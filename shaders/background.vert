// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"
#include "common/quad.glsl"

void main() { gl_Position = boxCorner(vec2(0.0), VIEW(size)); }
