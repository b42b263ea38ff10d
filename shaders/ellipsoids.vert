// SPDX-License-Identifier: MIT
// A quad around each ellipsoid's outline, and all that its rays have in common. The ellipsoid is
// μ + A·ball; in the ball's coordinates the eye stands at −a, a = A⁻¹μ, and the pixel's ray is
// D = A⁻¹d. It meets the ball where F = |D|² − |a × D|² > 0: a conic in pixel coordinates. Taken
// about the centre's own pixel, where a × D = 0, no difference of large numbers is left in it.
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"
#include "common/quad.glsl"
#include "interop/glyphs.h"

layout(set = 1, binding = 0, scalar) readonly buffer Instances { EllipsoidGlyph ellipsoids[]; };

layout(location = 0) flat out vec4 reference_l;  // reference pixel, l of the conic
layout(location = 1) flat out vec4 q_k;          // q and k of the conic
layout(location = 2) flat out vec4 D0_scale;     // ray at the reference pixel; depth = scale · t
layout(location = 3) flat out vec3 Du;
layout(location = 4) flat out vec3 Dv;
layout(location = 5) flat out vec3 a;
layout(location = 6) flat out mat3 A_inverse_transposed;  // takes the ball's normals to the eye's
layout(location = 9) flat out vec4 colour;

void main() {
  const EllipsoidGlyph e = ellipsoids[gl_InstanceIndex];
  const mat3 R = frame.views[gl_ViewIndex].R_eye_shared;
  const vec3 mu = eyeFromShared(e.centre);
  const mat3 A = mat3(R * e.axis0, R * e.axis1, R * e.axis2);
  const mat3 G = mat3(A[0] / dot(A[0], A[0]), A[1] / dot(A[1], A[1]), A[2] / dot(A[2], A[2]));
  a = mu * G;
  const vec3 axes_z = vec3(A[0].z, A[1].z, A[2].z);
  const float reach = length(axes_z);
  const bool behind = mu.z + reach <= frame.near;
  const bool around_eye = dot(a, a) <= 1.0;
  if (behind || around_eye) {
    gl_Position = nowhere();
    return;
  }
  // Outline is an ellipse; else it passes beside the eye and any pixel may see it.
  const bool in_front = mu.z - reach > 1e-3 * mu.z;

  const vec3 d0 = in_front ? mu / mu.z : vec3(0.0, 0.0, 1.0);
  const vec3 D = in_front ? a : d0 * G;
  const float scale = (in_front ? mu.z : 1.0) / length(D);
  const vec3 D0 = normalize(D);
  Du = scale * (rayPerU() * G);
  Dv = scale * (rayPerV() * G);
  const vec3 W0 = in_front ? vec3(0.0) : cross(a, D0);
  const vec3 Wu = cross(a, Du);
  const vec3 Wv = cross(a, Dv);
  const vec2 l = vec2(dot(D0, Du) - dot(W0, Wu), dot(D0, Dv) - dot(W0, Wv));
  const vec3 q = vec3(dot(Du, Du) - dot(Wu, Wu), dot(Du, Dv) - dot(Wu, Wv), dot(Dv, Dv) - dot(Wv, Wv));
  const vec2 reference = pixelFromEye(d0);
  reference_l = vec4(reference, l);
  q_k = vec4(q, 1.0 - dot(W0, W0));
  D0_scale = vec4(D0, scale);
  A_inverse_transposed = G;
  colour = e.colour;

  if (!in_front) {
    gl_Position = boxCorner(vec2(0.0), frame.views[gl_ViewIndex].size);
    return;
  }
  // The dual conic C = J Σ Jᵀ − … about the centre's pixel gives middle and shape of the outline.
  const PixelRows J = pixelRows(mu);
  const vec3 u = J.u * A;
  const vec3 v = J.v * A;
  const float c33 = dot(axes_z, axes_z) - mu.z * mu.z;
  const vec2 middle = vec2(dot(u, axes_z), dot(v, axes_z)) / c33;
  const vec3 S = vec3(middle.x * middle.x, middle.x * middle.y, middle.y * middle.y) -
                 vec3(dot(u, u), dot(u, v), dot(v, v)) / c33;
  const float angle = 0.5 * atan(2.0 * S.y, S.x - S.z);
  const vec2 n = vec2(cos(angle), sin(angle));
  const float variance1 = S.x * n.x * n.x + 2.0 * S.y * n.x * n.y + S.z * n.y * n.y;
  const float variance2 = S.x * n.y * n.y - 2.0 * S.y * n.x * n.y + S.z * n.x * n.x;
  const vec2 half_size = sqrt(max(vec2(variance1, variance2), 0.0)) + 1.0;
  const vec2 centre = reference + middle;
  const float reach_px = half_size.x + half_size.y;
  if (insideBorder(centre - reach_px) && insideBorder(centre + reach_px)) {
    const vec2 corner = stripCorner() * half_size;
    gl_Position = clipFromPixel(centre + corner.x * n + corner.y * vec2(-n.y, n.x));
  } else {
    const vec2 box = sqrt(max(vec2(S.x, S.z), 0.0)) + 1.0;
    gl_Position = boxCorner(centre - box, centre + box);
  }
}
