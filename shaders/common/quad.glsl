// SPDX-License-Identifier: MIT
// Quads made of nothing but the vertex's number.
// Depth is left to the fragment shader, or not tested.
vec4 clipFromPixel(vec2 px) {
  return vec4(2.0 * px / frame.views[eye].size - 1.0, 0.5, 1.0);
}

// A vertex that makes no fragment.
vec4 nowhere() { return vec4(2.0, 2.0, 0.5, 1.0); }

// Corners 0 … 3 of a strip: (−1, −1), (1, −1), (−1, 1), (1, 1).
vec2 stripCorner() { return vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 2.0 - 1.0; }
