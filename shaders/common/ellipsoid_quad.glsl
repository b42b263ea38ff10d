// SPDX-License-Identifier: MIT
// A quad around an ellipsoid's outline, and what its rays have in common.
layout(location = 0) flat out vec4 reference_l;  // reference pixel, l of the conic
layout(location = 1) flat out vec4 q_k;          // q and k of the conic
layout(location = 2) flat out vec4 D0_scale;
layout(location = 3) flat out vec3 Du;
layout(location = 4) flat out vec3 Dv;
layout(location = 5) flat out vec3 a;
layout(location = 6) flat out mat3 A_inverse_transposed;
layout(location = 9) flat out vec4 colour;

vec4 quadAround(Seen e) {
  if (!e.drawn) return nowhere();
  if (!e.in_front) return boxCorner(vec2(0.0), VIEW(size));
  const vec3 S = e.S;
  const float angle = 0.5 * atan(2.0 * S.y, S.x - S.z);
  const vec2 n = vec2(cos(angle), sin(angle));
  const float variance1 = S.x * n.x * n.x + 2.0 * S.y * n.x * n.y + S.z * n.y * n.y;
  const float variance2 = S.x * n.y * n.y - 2.0 * S.y * n.x * n.y + S.z * n.x * n.x;
  const vec2 half_size = sqrt(max(vec2(variance1, variance2), 0.0)) + 1.0;
  const vec2 centre = e.reference + e.middle;
  const float reach_px = half_size.x + half_size.y;
  if (insideBorder(centre - reach_px) && insideBorder(centre + reach_px)) {
    const vec2 corner = stripCorner() * half_size;
    return clipFromPixel(centre + corner.x * n + corner.y * vec2(-n.y, n.x));
  }
  const vec2 box = sqrt(max(vec2(S.x, S.z), 0.0)) + 1.0;
  return boxCorner(centre - box, centre + box);
}

void emitQuad(Seen e, vec4 its_colour) {
  reference_l = vec4(e.reference, e.conic.l);
  q_k = vec4(e.conic.q, e.conic.k);
  D0_scale = vec4(e.D0, e.scale);
  Du = e.Du;
  Dv = e.Dv;
  a = e.a;
  A_inverse_transposed = e.G;
  colour = its_colour;
  gl_Position = quadAround(e);
}
