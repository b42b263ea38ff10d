// SPDX-License-Identifier: MIT
// How much of a pixel (a unit square) a shape covers: the whole of anti-aliasing, as samples are
// one a pixel.

// Of the half plane n·x + d >= 0, |n| = 1, d taken at the pixel's centre. Exact.
float halfPlaneCoverage(vec2 n, float d) {
  const float a = max(abs(n.x), abs(n.y));
  const float b = min(abs(n.x), abs(n.y));
  const float s = abs(d);
  // Far enough from the corners the edge crosses two opposite sides: linear. Else it cuts a corner.
  const float corner = max(0.5 * (a + b) - s, 0.0);
  const float outside = s <= 0.5 * (a - b) ? 0.5 - s / a : corner * corner / max(2.0 * a * b, 1e-12);
  return d >= 0.0 ? 1.0 - outside : outside;
}

// f(x) = k + 2 l·x + q.x x² + 2 q.y x y + q.z y², positive inside.
struct Conic {
  float k;
  vec2 l;
  vec3 q;
};

struct ConicPoint {
  float f;        // value
  vec2 gradient;  // half of it
};

ConicPoint evaluate(Conic c, vec2 x) {
  const vec2 g = c.l + vec2(c.q.x * x.x + c.q.y * x.y, c.q.y * x.x + c.q.z * x.y);
  return ConicPoint(c.k + dot(c.l + g, x), g);
}

// Distance to the outline in pixels to first order, positive inside.
float edgeDistance(ConicPoint at) { return at.f / max(2.0 * length(at.gradient), 1e-30); }

// About the shorter semi-axis of an ellipse around the reference, px; of what is no ellipse large.
float thickness(Conic c) {
  const float sum = -(c.q.x + c.q.z);
  return sum > 1e-12 ? inversesqrt(sum) : 1e6;
}

// True where all of the pixel is inside: where its four corners are, as the inside is convex.
bool coversPixel(Conic c, ConicPoint at) {
  const vec2 g = at.gradient;
  const float across = min(0.5 * c.q.y - abs(g.x + g.y), -0.5 * c.q.y - abs(g.x - g.y));
  return at.f + 0.25 * (c.q.x + c.q.z) + across >= 0.0;
}

// False where none of the pixel is inside. True may be wrong in corners and beside thin ones: the
// conic's value lies below its tangent plane, and along the direction in which it rises fastest below
// the top of a parabola.
bool touchesPixel(Conic c, ConicPoint at) {
  const vec2 g = at.gradient;
  const float gg = dot(g, g);
  const float curvature = c.q.x * g.x * g.x + 2.0 * c.q.y * g.x * g.y + c.q.z * g.y * g.y;
  return at.f + abs(g.x) + abs(g.y) >= 0.0 && (curvature >= 0.0 || at.f * curvature <= gg * gg);
}

// Of the inside of a conic. An ellipse is cut into four strips across the direction that its edge
// crosses most directly; each is exact along its length, so that ellipses far smaller than a pixel
// come out right too. What is no ellipse (it passes beside the eye) is near and large: its edge is
// a line.
float conicCoverage(Conic c, ConicPoint at) {
  vec3 q = c.q;
  vec2 g = at.gradient;
  if (q.x >= 0.0 || q.x * q.z <= q.y * q.y) {
    const float size = max(length(g), 1e-30);
    return halfPlaneCoverage(g / size, 0.5 * at.f / size);
  }
  if (abs(g.y) > abs(g.x)) {
    g = g.yx;
    q = q.zyx;
  }
  const float scale = -1.0 / q.x;
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    const float y = (float(i) - 1.5) * 0.25;
    const float h = g.x + q.y * y;
    const float e = at.f + (2.0 * g.y + q.z * y) * y;
    const float w = sqrt(max(h * h - q.x * e, 0.0));
    sum += max(min((h + w) * scale, 0.5) - max((h - w) * scale, -0.5), 0.0);
  }
  return 0.25 * sum;
}
