// SPDX-License-Identifier: MIT
// From the points and their covariance to the ellipsoid of a pair. Pairs are numbered row by row of
// the strictly lower triangle: that of the points at places i < j of the table is j (j − 1) / 2 + i.
#include "../interop/pairs.h"
#include "area.glsl"

layout(set = 1, binding = 0, scalar) uniform Pairs { PairsData pairs; };
layout(set = 1, binding = 1) uniform samplerBuffer points;  // in an order of their own: mean,
// group, touching; xx, xy, yy of P, index
layout(set = 1, binding = 2) uniform samplerBuffer blocks;
layout(set = 1, binding = 3) uniform usamplerBuffer left_out;  // bit a pair
layout(set = 1, binding = 22) uniform usamplerBuffer in_view;  // bit a point, by index
layout(set = 1, binding = 23) uniform samplerBuffer then;  // as pairs_remember.comp, by block

const uint kDifferentGroups = 1u;  // PairsData::conditions
const uint kTouching = 2u;
const uint kLeftOut = 4u;
const uint kInView = 8u;

uvec2 pairOf(uint number) {
  uint j = uint(0.5 + sqrt(0.25 + 2.0 * float(number)));  // a float's rounding may miss by one
  if (j * (j - 1u) / 2u > number) --j;
  if (j * (j + 1u) / 2u <= number) ++j;
  return uvec2(number - j * (j - 1u) / 2u, j);
}

bool inView(uint index) {
  return (texelFetch(in_view, int(index >> 5)).x >> (index & 31u) & 1u) != 0u;
}

struct Pair {
  vec2 middle;  // m, relative to the origin
  vec3 P_d;     // xx, xy, yy, m²
  bool wanted;  // by all conditions but that of the area
  uint block;   // that of the two points
};

// Equation (13) of the paper: P_d = P_ii + P_jj − P_ij − P_ijᵀ.
Pair pairAt(uint number) {
  const uvec2 ij = pairOf(number);
  const vec4 a = texelFetch(points, int(2u * ij.x));
  const vec4 b = texelFetch(points, int(2u * ij.y));
  const vec4 P_ii = texelFetch(points, int(2u * ij.x + 1u));
  const vec4 P_jj = texelFetch(points, int(2u * ij.y + 1u));
  // Which of the two is transposed makes no difference.
  const uint row = uint(max(P_ii.w, P_jj.w));
  const uint column = uint(min(P_ii.w, P_jj.w));
  const uint block = row * (row + 1u) / 2u + column;
  const vec4 P_ji = texelFetch(blocks, int(block));
  const vec3 twice = vec3(2.0 * P_ji.x, P_ji.y + P_ji.z, 2.0 * P_ji.w);
  bool wanted = (a.z != b.z || (pairs.conditions & kDifferentGroups) == 0u) &&
                (a.w + b.w > 0.0 || (pairs.conditions & kTouching) == 0u);
  const bool some_left_out = (pairs.conditions & kLeftOut) != 0u;
  const uint bits = texelFetch(left_out, some_left_out ? int(number >> 5) : 0).x;
  wanted = wanted && !(some_left_out && (bits >> (number & 31u) & 1u) != 0u);
  if ((pairs.conditions & kInView) != 0u) wanted = wanted && inView(row) && inView(column);
  return Pair(0.5 * (a.xy + b.xy), (P_ii.xyz + P_jj.xyz) - twice, wanted, block);
}

// What the most are chosen by, as the bits of a float: growth is a ratio to the area that was.
uint keyOf(Pair pair, float area) {
  if (pairs.most_by == 0u) return floatBitsToUint(area);
  return floatBitsToUint(area / max(texelFetch(then, int(pair.block)).x, 1e-37));
}

// Eigenvalues (m², major first) and the major direction of a symmetric 2 × 2 matrix. Closed form,
// on the matrix divided by its trace, so that neither 1e-24 nor 1e6 m² leaves the range of floats.
struct Principal {
  vec2 eigenvalues;
  vec2 major;
};
Principal principalOf(vec3 P) {
  const float trace = max(abs(P.x) + abs(P.z), 1e-37);
  const vec3 p = P / trace;
  const vec2 h = vec2(0.5 * (p.x - p.z), p.y);
  const float radius = length(h);
  const float mean = 0.5 * (p.x + p.z);
  const float major = mean + radius;
  // det / major keeps digits that the difference cancels.
  const float minor =
      mean - radius < 1e-2 * major ? (p.x * p.z - p.y * p.y) / max(major, 1e-30) : mean - radius;
  // Half of h's angle.
  const float cos2 = radius > 0.0 ? h.x / radius : 1.0;
  const float c = sqrt(max(0.5 + 0.5 * cos2, 0.0));
  const float s = sqrt(max(0.5 - 0.5 * cos2, 0.0));
  const float exact = radius > 0.0 ? 0.5 * abs(h.y) / (radius * max(c, s)) : 0.0;
  const vec2 direction = c >= s ? vec2(c, exact) : vec2(exact, s);
  return Principal(trace * max(vec2(major, minor), 0.0),
                   vec2(direction.x, h.y < 0.0 ? -direction.y : direction.y));
}

vec2 semiAxes(vec2 eigenvalues) {
  if (pairs.law == 1u) return pairs.gain * eigenvalues;
  const vec2 sigma = sqrt(eigenvalues);
  if (pairs.law == 0u) return pairs.gain * sigma;
  // For small x the logarithm of 1 + x loses x's digits.
  const vec2 x = sigma / pairs.unit;
  return pairs.gain * 0.43429448 * mix(log(1.0 + x), x - 0.5 * x * x, lessThan(x, vec2(1e-3)));
}

struct Solid {
  vec3 centre;  // shared coordinates, m
  vec3 axis0, axis1, axis2;
  bool finite;
};

// As EllipsoidPass: no axis is shorter than 1e-4 of the longest, nor 1e-6 of the distance.
Solid solidOf(Pair pair) {
  const Principal principal = principalOf(pair.P_d);
  const vec3 centre =
      pairs.origin + pairs.scale * (pair.middle.x * pairs.ex + pair.middle.y * pairs.ey);
  vec2 semi = semiAxes(principal.eigenvalues);
  const float extent = length(centre) + semi.x;
  // Written so that NaN is not finite.
  const bool finite = extent < 1e30 && semi.y >= 0.0 && abs(pair.P_d.y) < 1e30 &&
                      pair.P_d.x >= -1e30 && pair.P_d.z >= -1e30;
  semi = max(semi, vec2(max(1e-4 * semi.x, 1e-6 * length(centre) + 1e-12)));
  const vec2 u = principal.major;
  return Solid(centre, semi.x * (u.x * pairs.ex + u.y * pairs.ey),
               semi.y * (u.x * pairs.ey - u.y * pairs.ex), semi.y * pairs.ez, finite);
}
