// SPDX-License-Identifier: MIT
// The finished picture shrunk where the display's lens will magnify it, each colour by its own.
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interop/lens.h"

layout(set = 0, binding = 0) uniform sampler2DArray drawn;
layout(set = 0, binding = 1, scalar) uniform Lenses { LensesData worn; };
layout(location = 0) out vec4 result;

void main() {
  const LensData lens = worn.lenses[gl_ViewIndex];
  if (lens.plain != 0) {
    result = texelFetch(drawn, ivec3(gl_FragCoord.xy, gl_ViewIndex), 0);
    return;
  }
  const vec2 size = vec2(textureSize(drawn, 0).xy);
  const vec2 off = gl_FragCoord.xy - lens.axis;
  const vec2 r = off / lens.half_height;
  const float s = dot(r, r);
  const float factor = 1.0 + s * (lens.k.x + s * (lens.k.y + s * lens.k.z));
  for (int c = 0; c < 3; ++c) {
    const vec2 at = (lens.axis + lens.scale[c] * factor * off) / size;
    result[c] = textureLod(drawn, vec3(at, gl_ViewIndex), 0.0)[c];
  }
  result.a = 1.0;
}
