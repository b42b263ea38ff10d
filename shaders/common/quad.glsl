// SPDX-License-Identifier: MIT
// Quads made of nothing but the vertex's number. No vertex ever leaves the clip volume: software
// rendering (lavapipe 22.3) draws what it has to clip into the first eye's picture, whatever the
// eye. So the viewport has a border around the picture, and quads are held inside of it.

// Depth is left to the fragment shader, or not tested.
vec4 clipFromPixel(vec2 px) {
  const vec2 size = VIEW(size);
  return vec4(2.0 * (px + frame.border_px) / (size + 2.0 * frame.border_px) - 1.0, 0.5, 1.0);
}

// A vertex that makes no fragment.
vec4 nowhere() { return vec4(0.0, 0.0, 0.5, 1.0); }

// Corners 0 … 3 of a strip: (−1, −1), (1, −1), (−1, 1), (1, 1).
vec2 stripCorner() { return vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 2.0 - 1.0; }

// Corner of the part of an upright box that lies in the picture.
vec4 boxCorner(vec2 low, vec2 high) {
  const vec2 corner = mix(low, high, 0.5 + 0.5 * stripCorner());
  return clipFromPixel(clamp(corner, vec2(0.0), VIEW(size)));
}

// True where a point may be a vertex as it is.
bool insideBorder(vec2 px) {
  const vec2 size = VIEW(size);
  return all(greaterThan(px, vec2(-frame.border_px + 1.0))) &&
         all(lessThan(px, size + frame.border_px - 1.0));
}
