// SPDX-License-Identifier: MIT
// The visibility buffer as a picture: each pixel is shaded once, for what is nearest in it.
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/coverage.glsl"
#include "common/view.glsl"
#include "common/ellipsoid.glsl"
#include "common/pairs.glsl"
#include "common/shade.glsl"

// As pairs_splat.comp: (number, depth) of what covers the pixel whole, then of what has its edge
// in it; all bits set where there is nothing.
layout(set = 1, binding = 10) uniform usamplerBuffer nearest;

layout(location = 0) out vec4 result;

const float kPlain = 0.8;  // how bright a lit glyph is on average

void main() {
  const uvec2 pixel = uvec2(gl_FragCoord.xy);
  const uvec2 size = uvec2(VIEW(size));
  const uvec4 entry = texelFetch(nearest, int((gl_ViewIndex * size.y + pixel.y) * size.x + pixel.x));
  const bool anything = min(entry.y, entry.w) != ~0u;
  const bool edge = entry.w < entry.y;
  const uint number = anything ? (edge ? entry.z : entry.x) : 0u;

  const Solid s = solidOf(pairAt(number));
  const mat3 R = VIEW(R_eye_shared);
  const Seen e = seen(eyeFromShared(s.centre), R * mat3(s.axis0, s.axis1, s.axis2));
  const vec2 x = gl_FragCoord.xy - e.reference;
  const ConicPoint at = evaluate(e.conic, x);
  const float coverage = edge ? conicCoverage(e.conic, at) : 1.0;
  const bool behind = edge && entry.y != ~0u;  // something else covers the whole pixel
  if (!anything || coverage <= 0.0 && !behind) discard;

  const Surface surface = surfaceAt(e.D0, e.Du, e.Dv, e.scale, e.a, e.G, x, at.f);
  gl_FragDepth = frame.near / uintBitsToFloat(edge && coverage > 0.0 ? entry.w : entry.y);
  const vec3 rgb = shade(pairs.colour.rgb, normalize(surface.normal), rayThrough(gl_FragCoord.xy),
                         edgeDistance(at));
  const vec3 plain = kLit ? kPlain * pairs.colour.rgb : pairs.colour.rgb;
  result = behind ? vec4(mix(plain, rgb, coverage), pairs.colour.a)
                  : vec4(rgb, pairs.colour.a * coverage);
}
