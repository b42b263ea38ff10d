// SPDX-License-Identifier: MIT
// The camera's picture behind the scene; undistorted on the way where there is a lookup map.
#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"

// What is not there is left out of the shader: software rendering (lavapipe 22.3) takes both ways of
// every branch, and each texture that is read costs a frame more than all that is drawn over it.
layout(constant_id = 0) const bool kTwoEyes = true;
layout(constant_id = 1) const bool kCopied = true;  // some picture is taken pixel by pixel
layout(constant_id = 2) const bool kMapped = true;  // some picture is seen through its map

layout(set = 1, binding = 0) uniform sampler2DArray picture0;
layout(set = 1, binding = 1) uniform sampler2DArray picture1;
layout(set = 1, binding = 2) uniform sampler2DArray map0;
layout(set = 1, binding = 3) uniform sampler2DArray map1;
layout(location = 0) out vec4 result;

vec4 seen(sampler2DArray picture, sampler2DArray map, uint kind) {
  const ivec3 pixel = ivec3(gl_FragCoord.xy, 0);
  if (kCopied && kind == 1) return texelFetch(picture, pixel, 0);
  if (!kMapped || kind == 0) return vec4(0.0);
  // Integer coordinates of the map are texel centres (OpenCV); outside the sampler gives black.
  const vec2 uv = texelFetch(map, pixel, 0).xy;
  const vec2 size = vec2(textureSize(picture, 0).xy);
  // Written so that NaN is outside too.
  const bool near_picture = uv.x > -1.0 && uv.y > -1.0 && uv.x < size.x && uv.y < size.y;
  if (!near_picture) return vec4(0.0);
  return textureLod(picture, vec3((uv + 0.5) / size, 0.0), 0.0);
}

void main() {
  const uint kind = VIEW(background);
  vec4 texel;
  if (kTwoEyes && gl_ViewIndex == 1) {
    texel = seen(picture1, map1, kind);
  } else {
    texel = seen(picture0, map0, kind);
  }
  result = vec4(texel.rgb, 1.0);
}
