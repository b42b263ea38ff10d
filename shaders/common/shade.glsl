// SPDX-License-Identifier: MIT
// Simple light: a lamp at the eye and a bright sky.
layout(constant_id = 0) const bool kLit = true;

// normal (unit) and ray in eye coordinates; distance to the silhouette and what the glyph measures
// across, in px.
vec3 shade(vec3 colour, vec3 normal, vec3 ray, float edge_px, float thickness_px) {
  if (!kLit) return colour;
  const float lamp = max(-dot(normal, normalize(ray)), 0.0);
  const float sky = 0.5 + 0.5 * dot(normal, VIEW(up_eye));
  const vec3 lit = colour * (0.30 + 0.45 * lamp + 0.35 * sky);
  // A dark rim keeps overlapping glyphs of one colour apart, and apart from the camera's picture.
  // What is not much thicker than the rim goes without: a crowd of small ones would be all rims.
  const float rim = (1.0 - smoothstep(0.6, 1.8, edge_px)) * smoothstep(1.0, 4.0, thickness_px);
  return lit * (1.0 - 0.65 * rim);
}
