// SPDX-License-Identifier: MIT
// A box around each cone's outline: the hull of its tip and its rim's ellipse. The two straight
// edges are the tangents from the tip to the rim: with J the picture's derivative at the tip, k the
// axis, r the radius, h the height, lines n through the tip touch where
// nᵀ (r² J Jᵀ − (r² + h²) Jk (Jk)ᵀ) n = 0.
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"
#include "common/quad.glsl"
#include "common/named.glsl"
#include "interop/glyphs.h"

layout(set = 1, binding = 0, scalar) readonly buffer Instances { ConeGlyph cones[]; };

layout(location = 0) flat out vec4 tip_rim_px;  // pictures of the tip and of the rim's middle
layout(location = 1) flat out vec4 edges;       // inward normals of the two edges; 0: no edges
layout(location = 2) flat out vec4 rim_l_sizes; // l of the rim's conic (k = 1); radius, height
layout(location = 3) flat out vec3 rim_q;
layout(location = 4) flat out vec3 polar;  // of the tip in the rim's conic: negative on its side
layout(location = 5) flat out vec3 tip;
layout(location = 6) flat out vec3 axis;
layout(location = 7) flat out vec4 colour;

// Unit normals of the null directions of [p q; q s], turned to look along `inside`.
vec4 nullDirections(float p, float q, float s, vec2 inside) {
  const float determinant = q * q - p * s;
  if (determinant <= 0.0) return vec4(0.0);
  const float root = sqrt(determinant);
  vec2 n1 = q >= 0.0 ? vec2(-(q + root), p) : vec2(root - q, p);
  vec2 n2 = q >= 0.0 ? vec2(s, -(q + root)) : vec2(s, root - q);
  n1 = normalize(n1);
  n2 = normalize(n2);
  return vec4(dot(n1, inside) < 0.0 ? -n1 : n1, dot(n2, inside) < 0.0 ? -n2 : n2);
}

void main() {
  const ConeGlyph cone = cones[gl_InstanceIndex];
  tip = eyeFromShared(cone.tip);
  axis = VIEW(R_eye_shared) * cone.axis;
  const float r = cone.radius;
  const float h = cone.height;
  const vec3 rim = tip + h * axis;
  colour = colourOrName(cone.colour, gl_InstanceIndex);
  const float rim_reach = r * sqrt(max(1.0 - axis.z * axis.z, 0.0));
  if (tip.z <= frame.near || rim.z - rim_reach <= frame.near) {
    gl_Position = nowhere();
    return;
  }
  const vec2 tip_px = pixelFromEye(tip);
  const vec2 rim_px = pixelFromEye(rim);
  tip_rim_px = vec4(tip_px, rim_px);

  // The rim's conic: the ray d meets the rim's plane inside the rim where
  // r² (d·k)² > |(c·k) d − (d·k) c|², c its middle; about the middle's pixel.
  const vec3 du = rayPerU();
  const vec3 dv = rayPerV();
  const float ck = dot(rim, axis);
  const float dk = ck / rim.z;
  const float scale = 1.0 / (abs(dk) < 1e-4 ? 1e-4 : dk);
  const vec2 slope = vec2(dot(du, axis), dot(dv, axis)) * scale;
  const vec3 Vu = (ck * du - dot(du, axis) * rim) * (scale / r);
  const vec3 Vv = (ck * dv - dot(dv, axis) * rim) * (scale / r);
  rim_l_sizes = vec4(slope, r, h);
  rim_q = vec3(slope.x * slope.x - dot(Vu, Vu), slope.x * slope.y - dot(Vu, Vv),
               slope.y * slope.y - dot(Vv, Vv));
  const vec2 x = tip_px - rim_px;
  const vec2 Qx = vec2(rim_q.x * x.x + rim_q.y * x.y, rim_q.y * x.x + rim_q.z * x.y);
  polar = vec3(Qx + slope, dot(slope, x) + 1.0);

  const PixelRows J = pixelRows(tip);
  const vec2 g = vec2(dot(J.u, axis), dot(J.v, axis));
  const float rr = r * r;
  const float hh = rr + h * h;
  edges = nullDirections(rr * dot(J.u, J.u) - hh * g.x * g.x, rr * dot(J.u, J.v) - hh * g.x * g.y,
                         rr * dot(J.v, J.v) - hh * g.y * g.y, g);

  const PixelRows Jr = pixelRows(rim);
  const vec2 gr = vec2(dot(Jr.u, axis), dot(Jr.v, axis));
  const float c33 = rr * (1.0 - axis.z * axis.z) - rim.z * rim.z;
  const vec2 middle = rr * (vec2(Jr.u.z, Jr.v.z) - gr * axis.z) / c33;
  const vec2 variance =
      middle * middle - rr * (vec2(dot(Jr.u, Jr.u), dot(Jr.v, Jr.v)) - gr * gr) / c33;
  const vec2 reach = sqrt(max(variance, 0.0));
  const vec2 low = min(tip_px, rim_px + middle - reach) - 1.0;
  const vec2 high = max(tip_px, rim_px + middle + reach) + 1.0;
  gl_Position = boxCorner(low, high);
}
