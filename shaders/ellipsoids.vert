// SPDX-License-Identifier: MIT
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
#include "interop/glyphs.h"

layout(set = 1, binding = 0, scalar) readonly buffer Instances { EllipsoidGlyph ellipsoids[]; };

void main() {
  const EllipsoidGlyph e = ellipsoids[gl_InstanceIndex];
  const mat3 R = VIEW(R_eye_shared);
  emitQuad(seen(eyeFromShared(e.centre), R * mat3(e.axis0, e.axis1, e.axis2)),
           colourOrName(e.colour, gl_InstanceIndex));
}
