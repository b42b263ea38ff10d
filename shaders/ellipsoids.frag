// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/coverage.glsl"
#include "common/view.glsl"
#include "common/ellipsoid.glsl"
#include "common/shade.glsl"
#include "common/named.glsl"

layout(constant_id = 1) const uint kPart = 0u;  // 0: whole, 1: pixels covered whole, 2: the others

layout(location = 0) flat in vec4 reference_l;
layout(location = 1) flat in vec4 q_k;
layout(location = 2) flat in vec4 D0_scale;
layout(location = 3) flat in vec3 Du;
layout(location = 4) flat in vec3 Dv;
layout(location = 5) flat in vec3 a;
layout(location = 6) flat in mat3 A_inverse_transposed;
layout(location = 9) flat in vec4 colour;
layout(location = 0) out vec4 result;

void main() {
  const vec2 x = gl_FragCoord.xy - reference_l.xy;
  const Conic conic = Conic(q_k.w, reference_l.zw, q_k.xyz);
  const ConicPoint at = evaluate(conic, x);
  float coverage = 1.0;
  if (kPart != 1u) coverage = conicCoverage(conic, at);
  const bool whole = coversPixel(conic, at);
  if (kPart == 1u && !whole || kPart == 2u && whole) coverage = 0.0;

  const Surface surface =
      surfaceAt(D0_scale.xyz, Du, Dv, D0_scale.w, a, A_inverse_transposed, x, at.f);
  if (!covers(coverage, colour) || surface.depth < frame.near) discard;
  gl_FragDepth = frame.near / surface.depth;
  const vec3 rgb = shade(colour.rgb, normalize(surface.normal), rayThrough(gl_FragCoord.xy),
                         edgeDistance(at), thickness(conic));
  result = covering(coverage, vec4(rgb, colour.a));
}
