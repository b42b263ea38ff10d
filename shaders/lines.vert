// SPDX-License-Identifier: MIT
// A quad around the picture of one piece of a polyline, round ends included.
#version 460
#extension GL_ARB_shader_viewport_layer_array : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/eye.vert.glsl"
#include "common/view.glsl"
#include "common/quad.glsl"
#include "interop/glyphs.h"

layout(set = 1, binding = 0, scalar) readonly buffer Instances { SegmentGlyph segments[]; };

layout(location = 0) flat out vec4 from_to;
layout(location = 1) flat out vec4 previous_next;
layout(location = 2) flat out float half_width;
layout(location = 3) flat out vec4 colour;

// Where the way from p (behind the eye) to q (in front) comes into sight.
vec3 clipped(vec3 p, vec3 q) {
  return p.z >= frame.near ? p : mix(p, q, (frame.near - p.z) / (q.z - p.z));
}

void main() {
  const SegmentGlyph s = segments[instanceInEye()];
  const vec3 from = eyeFromShared(s.from);
  const vec3 to = eyeFromShared(s.to);
  if (from.z < frame.near && to.z < frame.near) {
    gl_Position = nowhere();
    return;
  }
  const vec3 seen_from = clipped(from, to);
  const vec3 seen_to = clipped(to, from);
  const vec3 previous = from.z < frame.near ? seen_from : clipped(eyeFromShared(s.previous), from);
  const vec3 next = to.z < frame.near ? seen_to : clipped(eyeFromShared(s.next), to);

  const vec2 p = pixelFromEye(seen_from);
  const vec2 q = pixelFromEye(seen_to);
  from_to = vec4(p, q);
  previous_next = vec4(pixelFromEye(previous), pixelFromEye(next));
  // Lines thinner than a pixel are a pixel wide and fainter.
  half_width = 0.5 * max(s.width_px, 1.0);
  colour = vec4(s.colour.rgb, s.colour.a * min(s.width_px, 1.0));

  const vec2 d = q - p;
  const vec2 along = dot(d, d) > 0.0 ? normalize(d) : vec2(1.0, 0.0);
  const vec2 corner = stripCorner() * (half_width + 1.0);
  gl_Position = clipFromPixel((corner.x < 0.0 ? p : q) + corner.x * along +
                              corner.y * vec2(-along.y, along.x));
}
