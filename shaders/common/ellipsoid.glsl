// SPDX-License-Identifier: MIT
// An ellipsoid as one eye sees it. The ellipsoid is μ + A·ball; in the ball's coordinates the eye
// stands at −a, a = A⁻¹μ, and the pixel's ray is D = A⁻¹d. It meets the ball where
// F = |D|² − |a × D|² > 0: a conic in pixel coordinates. Taken about the centre's own pixel, where
// a × D = 0, no difference of large numbers is left in it.

struct Seen {
  bool drawn;      // some of it is before the near plane, and the eye is not inside
  bool in_front;   // its outline is an ellipse; else it passes beside the eye: any pixel may see it
  vec2 reference;  // px
  Conic conic;     // about the reference
  vec3 D0, Du, Dv;  // ray at the reference, and how it moves with the pixel
  float scale;      // depth = scale · t
  vec3 a;
  mat3 G;  // A⁻¹ transposed: takes the ball's normals to the eye's
  // Where it is in front: the outline is {middle + x : xᵀ S⁻¹ x ≤ 1}, middle from the reference.
  vec2 middle;
  vec3 S;  // xx, xy, yy, px²
};

Seen seen(vec3 mu, mat3 A) {
  Seen e;
  e.G = mat3(A[0] / dot(A[0], A[0]), A[1] / dot(A[1], A[1]), A[2] / dot(A[2], A[2]));
  e.a = mu * e.G;
  const vec3 axes_z = vec3(A[0].z, A[1].z, A[2].z);
  const float reach = length(axes_z);
  e.drawn = mu.z + reach > frame.near && dot(e.a, e.a) > 1.0;
  e.in_front = mu.z - reach > 1e-3 * mu.z;

  const vec3 d0 = e.in_front ? mu / mu.z : vec3(0.0, 0.0, 1.0);
  const vec3 D = e.in_front ? e.a : d0 * e.G;
  e.scale = (e.in_front ? mu.z : 1.0) / length(D);
  e.D0 = normalize(D);
  e.Du = e.scale * (rayPerU() * e.G);
  e.Dv = e.scale * (rayPerV() * e.G);
  const vec3 W0 = e.in_front ? vec3(0.0) : cross(e.a, e.D0);
  const vec3 Wu = cross(e.a, e.Du);
  const vec3 Wv = cross(e.a, e.Dv);
  e.conic.l = vec2(dot(e.D0, e.Du) - dot(W0, Wu), dot(e.D0, e.Dv) - dot(W0, Wv));
  e.conic.q = vec3(dot(e.Du, e.Du) - dot(Wu, Wu), dot(e.Du, e.Dv) - dot(Wu, Wv),
                   dot(e.Dv, e.Dv) - dot(Wv, Wv));
  e.conic.k = 1.0 - dot(W0, W0);
  e.reference = pixelFromEye(d0);

  // The dual conic C = J Σ Jᵀ − … about the centre's pixel gives middle and shape of the outline.
  const PixelRows J = pixelRows(mu);
  const vec3 u = J.u * A;
  const vec3 v = J.v * A;
  const float c33 = dot(axes_z, axes_z) - mu.z * mu.z;
  e.middle = vec2(dot(u, axes_z), dot(v, axes_z)) / c33;
  e.S = vec3(e.middle.x * e.middle.x, e.middle.x * e.middle.y, e.middle.y * e.middle.y) -
        vec3(dot(u, u), dot(u, v), dot(v, v)) / c33;
  return e;
}

// One point of it: where the ray of a pixel meets it first. The ray of an edge pixel whose centre
// misses the ellipsoid takes the point where it passes closest.
struct Surface {
  float depth;
  vec3 normal;  // of the eye, not of unit length
};

// x: from the reference; f: the conic's value there.
Surface surfaceAt(vec3 D0, vec3 Du, vec3 Dv, float scale, vec3 a, mat3 G, vec2 x, float f) {
  const vec3 D = D0 + Du * x.x + Dv * x.y;
  const float DD = dot(D, D);
  const float root = sqrt(max(f, 0.0));
  const vec3 ball_normal = -(cross(D, cross(a, D)) + root * D) / DD;
  return Surface(scale * (dot(a, D) - root) / DD, G * ball_normal);
}
