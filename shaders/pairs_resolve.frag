// SPDX-License-Identifier: MIT
// The visibility buffer as a picture: each pixel is shaded once, for what is nearest in it.
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/coverage.glsl"
#include "common/view.glsl"
#include "common/shade.glsl"
#include "common/named.glsl"
#include "interop/pairs.h"

layout(set = 1, binding = 0, scalar) uniform Pairs { PairsData pairs; };
// As pairs_splat.comp: (number, depth) of what covers the pixel whole, then of what has its edge
// in it; all bits set where there is nothing.
layout(set = 1, binding = 10) uniform usamplerBuffer nearest;
layout(set = 1, binding = 12) uniform samplerBuffer faces;

layout(location = 0) out vec4 result;

const float kPlain = 0.8;  // how bright a lit glyph is on average

void main() {
  const uvec2 pixel = uvec2(gl_FragCoord.xy);
  const uvec2 size = uvec2(VIEW(size));
  const uvec4 entry =
      texelFetch(nearest, int((gl_ViewIndex * size.y + pixel.y) * size.x + pixel.x));
  const bool anything = min(entry.y, entry.w) != ~0u;
  const bool edge = entry.w < entry.y;
  const bool behind = edge && entry.y != ~0u;  // something else covers the whole pixel
  const uint number = anything ? (edge ? entry.z : entry.x) : 0u;

  const int at = int(3u * (gl_ViewIndex * pairs.pairs + number));
  const vec4 mu_k = texelFetch(faces, at);
  const vec4 l_q = texelFetch(faces, at + 1);
  const vec4 q_u = texelFetch(faces, at + 2);
  const vec3 mu = mu_k.xyz;
  const bool in_front = mu_k.w == 1.0;
  const vec2 reference = in_front ? pixelFromEye(mu) : VIEW(principal);
  const Conic conic = Conic(mu_k.w, l_q.xy, vec3(l_q.zw, q_u.x));
  const ConicPoint here = evaluate(conic, gl_FragCoord.xy - reference);
  const float coverage = edge ? conicCoverage(conic, here) : 1.0;
  if (!anything || coverage <= 0.0 && !behind) discard;
  if (kKind > 0u) {
    const bool its_own = !behind || coverage >= 0.5;
    const vec4 name = colourOrName(pairs.colour, its_own ? number : entry.x);
    if (!covers(its_own ? coverage : 1.0, name)) discard;
    gl_FragDepth = frame.near / uintBitsToFloat(its_own && edge ? entry.w : entry.y);
    result = name;
    return;
  }

  const float seen_depth = uintBitsToFloat(edge ? entry.w : entry.y);
  gl_FragDepth = frame.near / (coverage > 0.0 ? seen_depth : uintBitsToFloat(entry.y));
  // The normal of an ellipsoid whose axes but one, along u, are alike: what lies along u of the way
  // from the centre shrinks by the ratio of the squared axes.
  const vec3 ray = rayThrough(gl_FragCoord.xy);
  const vec3 way = seen_depth * ray - mu;
  const float u_z = sqrt(max(1.0 - dot(q_u.yz, q_u.yz), 0.0));
  const vec3 u = vec3(q_u.yz, q_u.w < 0.0 ? -u_z : u_z);
  const vec3 normal = way - (1.0 - abs(q_u.w)) * dot(u, way) * u;
  const vec3 rgb = shade(pairs.colour.rgb, normalize(normal), ray, edgeDistance(here),
                         thickness(conic));
  const vec3 plain = kLit ? kPlain * pairs.colour.rgb : pairs.colour.rgb;
  result = behind ? vec4(mix(plain, rgb, coverage), pairs.colour.a)
                  : vec4(rgb, pairs.colour.a * coverage);
}
