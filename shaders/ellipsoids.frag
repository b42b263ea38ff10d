// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/coverage.glsl"
#include "common/view.glsl"
#include "common/shade.glsl"

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
  const float coverage = conicCoverage(conic, at);

  // Edge pixels whose centre misses the ellipsoid take the point where the ray passes closest.
  const vec3 D = D0_scale.xyz + Du * x.x + Dv * x.y;
  const float DD = dot(D, D);
  const float root = sqrt(max(at.f, 0.0));
  const float depth = D0_scale.w * (dot(a, D) - root) / DD;
  if (coverage <= 0.0 || depth < frame.near) discard;
  gl_FragDepth = frame.near / depth;

  vec3 rgb = colour.rgb;
  if (kLit) {
    const vec3 ball_normal = -(cross(D, cross(a, D)) + root * D) / DD;
    const vec3 normal = normalize(A_inverse_transposed * ball_normal);
    const vec2 uv = gl_FragCoord.xy - frame.views[gl_ViewIndex].principal;
    const vec3 ray = vec3(0.0, 0.0, 1.0) + uv.x * rayPerU() + uv.y * rayPerV();
    rgb = shade(rgb, normal, ray, edgeDistance(at));
  }
  result = vec4(rgb, colour.a * coverage);
}
