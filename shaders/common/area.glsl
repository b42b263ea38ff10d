// SPDX-License-Identifier: MIT
// What covariances (xx, xy, yy, m²) are ordered by: √det, m². On the matrix divided by its trace, so
// that neither 1e-24 nor 1e6 m² leaves the range of floats.
float areaOf(vec3 P) {
  const float trace = abs(P.x) + abs(P.z);
  const vec3 p = P / max(trace, 1e-37);
  return trace * sqrt(max(p.x * p.z - p.y * p.y, 0.0));
}
