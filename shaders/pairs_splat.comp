// SPDX-License-Identifier: MIT
// Splats the ellipsoids of all chosen pairs into the visibility buffer: for each pixel of each view
// the nearest of those that cover it whole, and the nearest of those whose edge runs through it.
// Those of at most kSmallBox px are done by one lane each; the others are put on a list for the second
// dispatch, in which a work group, or for very large ones up to kSlices of them, do one together.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
#include "common/pair_wanted.glsl"
#include "common/pair_tiles.glsl"

layout(constant_id = 0) const bool kLarge = false;  // the second dispatch
layout(local_size_x = 64) in;

// Depth's bits above the pair's number: the least is the nearest, and of equally near ones the
// first. Two entries a pixel, views one after another.
layout(set = 1, binding = 8, scalar) buffer Visibility { uint64_t nearest[]; };
layout(set = 1, binding = 9) uniform usamplerBuffer nearest_words;  // the same memory
// Of pairs, one a work group, the nearest first: 64 points i, a lane each, by as many rows j as make
// 64 rectangles one above another. First i, first j above it.
layout(set = 1, binding = 27) uniform usamplerBuffer rectangles;
layout(set = 1, binding = 5, scalar) buffer Large { uvec2 large[]; };  // number; view and slices

const int kSmallBox = 64;      // px, either side
const uint kSlices = 8u;
const int kRowsOfASlice = 64;

// What the resolve pass needs to shade a pair: three entries a pair, views one after another.
layout(set = 1, binding = 11, scalar) writeonly buffer Faces { vec4 faces[]; };
layout(set = 1, binding = 13, scalar) writeonly buffer Tiles { uint tiles[]; };

void keepFace(uint view, uint number, Solid s, Seen e) {
  const uint at = 3u * (view * pairs.pairs + number);
  const float ratio = dot(s.axis1, s.axis1) / dot(s.axis0, s.axis0);
  const vec3 u = VIEW(R_eye_shared) * normalize(s.axis0);
  faces[at] = vec4(eyeFromShared(s.centre), e.conic.k);
  faces[at + 1u] = vec4(e.conic.l, e.conic.q.xy);
  faces[at + 2u] = vec4(e.conic.q.z, u.x, u.y, u.z < 0.0 ? -ratio : ratio);
}

void touchTiles(uint view, Box box) {
  const uvec2 all = tileCounts();
  const uvec2 first = uvec2(box.low) / kTile;
  const uvec2 last = uvec2(box.high) / kTile;
  for (uint y = first.y; y <= last.y; ++y) {
    for (uint x = first.x; x <= last.x; ++x) tiles[(view * all.y + y) * all.x + x] = 1u;
  }
}

// What depth and coverage of a pixel need: the conic, and depth = scale (a·D − √F) / |D|² with
// numerator and denominator as polynomials of the pixel.
struct Rays {
  Conic conic;
  vec2 reference;
  float scale;
  vec3 aD;            // a·D: constant, per u, per v
  vec3 DD0;           // |D|²: constant, half of the slopes
  vec3 DD2;           // uu, uv, vv
};
Rays raysOf(Seen e) {
  return Rays(e.conic, e.reference, e.scale, vec3(dot(e.a, e.D0), dot(e.a, e.Du), dot(e.a, e.Dv)),
              vec3(dot(e.D0, e.D0), dot(e.D0, e.Du), dot(e.D0, e.Dv)),
              vec3(dot(e.Du, e.Du), dot(e.Du, e.Dv), dot(e.Dv, e.Dv)));
}

// What a pixel would get.
struct Splat {
  bool hit;
  uint entry, bits;
};

Splat splatAt(Rays r, ivec2 pixel, bool inside_box, uint base, uint width) {
  const vec2 x = vec2(pixel) + 0.5 - r.reference;
  const ConicPoint at = evaluate(r.conic, x);
  const float aD = r.aD.x + dot(r.aD.yz, x);
  const vec2 slope = r.DD0.yz + vec2(r.DD2.x * x.x + r.DD2.y * x.y, r.DD2.y * x.x + r.DD2.z * x.y);
  const float DD = r.DD0.x + dot(r.DD0.yz + slope, x);
  const float depth = r.scale * (aD - sqrt(max(at.f, 0.0))) / DD;
  const bool hit = inside_box && depth >= frame.near && touchesPixel(r.conic, at);
  const uint layer = coversPixel(r.conic, at) ? 0u : 1u;
  const uint entry = base + 2u * (uint(pixel.y) * width + uint(pixel.x)) + layer;
  return Splat(hit, hit ? entry : base, floatBitsToUint(depth));
}

// Most are hidden: a plain look first. Entries only ever fall, so an old one does no harm.
bool nearer(Splat s) { return s.hit && s.bits <= texelFetch(nearest_words, int(2u * s.entry + 1u)).x; }

// Two neighbours at once: waiting for the memory of one is work on the other.
void splatPixels(Rays r, ivec2 pixel, ivec2 step, bool second_inside, uint base, uint width,
                 uint number) {
  const Splat one = splatAt(r, pixel, true, base, width);
  const Splat two = splatAt(r, pixel + step, second_inside, base, width);
  const bool one_nearer = nearer(one);
  const bool two_nearer = nearer(two);
  if (one_nearer) atomicMin(nearest[one.entry], uint64_t(one.bits) << 32 | uint64_t(number));
  if (two_nearer) atomicMin(nearest[two.entry], uint64_t(two.bits) << 32 | uint64_t(number));
}

void splatSmall(uint number, uint least_key, inout Tally tally) {
  const Pair pair = pairAt(number);
  if (!isChosen(pair, least_key)) return;
  ++tally.chosen;
  const Solid solid = solidOf(pair);
  if (!solid.finite) {
    ++tally.not_finite;
    return;
  }
  bool in_picture = false;
  for (uint view = 0u; view < pairs.views; ++view) {
    const Seen e = seenBy(view, solid);
    Box box = boxOf(e);
    if (empty(box)) continue;
    in_picture = true;
    const ivec2 size = box.high - box.low + 1;
    keepFace(view, number, solid, e);
    if (max(size.x, size.y) > kSmallBox) {
      const uint slices = min(uint(size.y / kRowsOfASlice) + 1u, kSlices);
      large[atomicAdd(counts.large, 1u)] = uvec2(number, view | slices << 1);
      continue;
    }
    touchTiles(view, box);
    const uint width = uint(VIEW(size).x);
    const uint base = 2u * view * width * uint(VIEW(size).y);
    const Rays rays = raysOf(e);
    ivec2 at = box.low;
    while (at.y <= box.high.y) {
      splatPixels(rays, at, ivec2(1, 0), at.x < box.high.x, base, width, number);
      at.x += 2;
      if (at.x > box.high.x) at = ivec2(box.low.x, at.y + 1);
    }
  }
  if (in_picture) ++tally.drawn;
}

// Work group (i, s): bands of eight rows s, s + slices … of the i-th large one.
void splatLarge() {
  const uint count = counts.large;
  for (uint i = gl_WorkGroupID.x; i < count; i += gl_NumWorkGroups.x) {
    const uint number = large[i].x;
    const uint view = large[i].y & 1u;
    const uint slices = large[i].y >> 1;
    const uint slice = gl_WorkGroupID.y;
    if (slice >= slices) continue;
    const Seen e = seenBy(view, solidOf(pairAt(number)));
    const Box box = boxOf(e);
    if (slice == 0u && gl_LocalInvocationIndex == 0u) touchTiles(view, box);
    const uint width = uint(VIEW(size).x);
    const uint base = 2u * view * width * uint(VIEW(size).y);
    const Rays rays = raysOf(e);
    const ivec2 lane = ivec2(gl_LocalInvocationIndex & 7u, gl_LocalInvocationIndex >> 3);
    for (int y = box.low.y + 8 * int(slice) + lane.y; y <= box.high.y; y += 8 * int(slices)) {
      for (int x = box.low.x + lane.x; x <= box.high.x; x += 16) {
        splatPixels(rays, ivec2(x, y), ivec2(8, 0), x + 8 <= box.high.x, base, width, number);
      }
    }
  }
}

void main() {
  if (kLarge) {
    splatLarge();
    return;
  }
  const uint least_key = counts.least_key;
  Tally tally = noTally();
  const uint rectangle = texelFetch(rectangles, int(gl_WorkGroupID.x)).x;
  const uint i = (rectangle & 0xFFFFu) + gl_LocalInvocationID.x;
  const uint first_j = rectangle >> 16;
  const uint rows = (pairs.points + 63u) / 64u;
  for (uint j = first_j; j < min(first_j + rows, pairs.points); ++j) {
    if (i < j) splatSmall(j * (j - 1u) / 2u + i, least_key, tally);
  }
  add(tally);
}
