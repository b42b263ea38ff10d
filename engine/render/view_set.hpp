// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "engine/render/options.hpp"
#include "engine/scene/glyphs.hpp"
#include "engine/scene/view.hpp"
#include "shaders/interop/frame.h"

namespace slamscope::engine {

/// How far the viewport reaches past the picture on each side (see shaders/common/quad.glsl).
constexpr float kBorderPx = 256.0F;

/// The eyes of one frame, and the "shared" coordinates that glyphs are uploaded in: those of the
/// first eye, computed in double, so that float is only ever asked for what is relative to the
/// viewer and moving world and camera together changes nothing.
class ViewSet {
 public:
  /// Throws std::invalid_argument where a camera's size is not width × height, a focal length is
  /// not positive, or a background does not fit.
  ViewSet(std::span<const View> views, int width, int height, const RenderOptions& options);

  [[nodiscard]] std::span<const View> views() const { return views_; }
  [[nodiscard]] const interop::FrameData& data() const { return data_; }
  [[nodiscard]] const RenderOptions& options() const { return options_; }
  [[nodiscard]] const Eigen::Isometry3d& T_shared_scene() const { return T_shared_scene_; }

  [[nodiscard]] interop::vec3 point(const Eigen::Vector3d& p_scene) const;
  [[nodiscard]] interop::vec3 direction(const Eigen::Vector3d& v_scene) const;
  /// Of what stands in the scene: faded by the options' opacity.
  [[nodiscard]] interop::vec4 colour(const Rgba& colour) const;

 private:
  std::span<const View> views_;
  RenderOptions options_;
  Eigen::Isometry3d T_shared_scene_;
  interop::FrameData data_ = {};
};

[[nodiscard]] interop::vec2 toVec2(const Eigen::Vector2d& v);
[[nodiscard]] interop::vec3 toVec3(const Eigen::Vector3d& v);
[[nodiscard]] interop::vec4 toVec4(const Rgba& colour);

}  // namespace slamscope::engine
