// SPDX-License-Identifier: MIT
// The quad of one chosen pair's ellipsoid.
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/coverage.glsl"
#include "common/view.glsl"
#include "common/ellipsoid.glsl"
#include "common/quad.glsl"
#include "common/named.glsl"
#include "common/ellipsoid_quad.glsl"
#include "common/pairs.glsl"

layout(set = 1, binding = 5, scalar) readonly buffer Chosen { uint chosen[]; };

void main() {
  const uint number = chosen[gl_InstanceIndex];
  const Solid s = solidOf(pairAt(number));
  const mat3 R = VIEW(R_eye_shared);
  emitQuad(seen(eyeFromShared(s.centre), R * mat3(s.axis0, s.axis1, s.axis2)),
           colourOrName(pairs.colour, number));
}
