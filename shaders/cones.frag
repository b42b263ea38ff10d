// SPDX-License-Identifier: MIT
// The side is flat in the cone's colour, so that its two edges are straight steps of one height all
// along and the tip can be measured in the picture; light falls on the lid alone.
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/coverage.glsl"
#include "common/view.glsl"
#include "common/shade.glsl"
#include "common/named.glsl"

// Which fragments: the inside, that hides what is behind, or the edge pixels, that are drawn last
// and leave the depth alone (else what is behind a cone would end before it reaches its edge).
layout(constant_id = 1) const bool kEdges = false;

layout(location = 0) flat in vec4 tip_rim_px;
layout(location = 1) flat in vec4 edges;
layout(location = 2) flat in vec4 rim_l_sizes;
layout(location = 3) flat in vec3 rim_q;
layout(location = 4) flat in vec3 polar;
layout(location = 5) flat in vec3 tip;
layout(location = 6) flat in vec3 axis;
layout(location = 7) flat in vec4 colour;
layout(location = 0) out vec4 result;

// Depth where the ray meets the side. Edge pixels that miss it take the closest point.
float sideDepth(vec3 ray) {
  const float r = rim_l_sizes.z;
  const float h = rim_l_sizes.w;
  const float bend = 1.0 + r * r / (h * h);
  const float tip_k = dot(tip, axis);
  const float ray_k = dot(ray, axis);
  const float A = dot(ray, ray) - bend * ray_k * ray_k;
  const float B = dot(ray, tip) - bend * ray_k * tip_k;
  const float C = dot(tip, tip) - bend * tip_k * tip_k;
  const float root = sqrt(max(B * B - A * C, 0.0));
  const float sum = B + (B < 0.0 ? -root : root);
  const vec2 depths = vec2(sum / (A == 0.0 ? 1e-20 : A), C / (sum == 0.0 ? 1e-20 : sum));
  const vec2 heights = depths * ray_k - tip_k;
  float depth = 1e30;
  for (int i = 0; i < 2; ++i) {
    const bool on_side = heights[i] > -0.1 * h && heights[i] < 1.1 * h && depths[i] > frame.near;
    if (on_side) depth = min(depth, depths[i]);
  }
  return depth < 1e30 ? depth : tip.z;
}

void main() {
  const vec2 x = gl_FragCoord.xy - tip_rim_px.zw;
  const vec2 y = gl_FragCoord.xy - tip_rim_px.xy;
  const Conic rim = Conic(1.0, rim_l_sizes.xy, rim_q);
  const ConicPoint at = evaluate(rim, x);
  const float lid = conicCoverage(rim, at);
  const bool has_edges = dot(edges, edges) > 0.0;
  float coverage = lid;
  if (has_edges && dot(polar.xy, x) + polar.z < 0.0) {
    coverage = max(halfPlaneCoverage(edges.xy, dot(edges.xy, y)) +
                       halfPlaneCoverage(edges.zw, dot(edges.zw, y)) - 1.0,
                   0.0);
  }
  const bool inside = coverage > 0.996;
  if (!covers(coverage, colour) || inside == kEdges) discard;

  const vec2 uv = gl_FragCoord.xy - VIEW(principal);
  const vec3 ray = vec3(0.0, 0.0, 1.0) + uv.x * rayPerU() + uv.y * rayPerV();
  const vec3 middle = tip + rim_l_sizes.w * axis;
  const float plane = dot(middle, axis);
  const bool from_above = plane < 0.0;
  const float depth = from_above && at.f > 0.0 ? plane / dot(ray, axis) : sideDepth(ray);
  gl_FragDepth = frame.near / max(depth, frame.near);

  vec3 rgb = colour.rgb;
  if (kLit && from_above) rgb = mix(rgb, rgb * 0.72, lid);
  result = covering(coverage, vec4(rgb, colour.a));
}
