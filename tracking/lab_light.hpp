// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace slamscope::tracking::lab {

/// Light at a surface, one number per source: sky light from everywhere, the window, the lamp. 1 in
/// all together is "as bright as the middle of the room".
using Light = Eigen::Array3f;

/// Something upright and round that keeps light from the floor.
struct Blocker {
  Eigen::Vector2d p_world = Eigen::Vector2d::Zero();
  double radius = 0, height = 0;  ///< m
  double contact = 0.03;          ///< how far the darkness at its foot reaches, m
};

/// Light at a point of the room with nothing in the way.
[[nodiscard]] Light openLight(const Eigen::Vector3d& p_world, const Eigen::Vector3d& normal);
/// What a blocker lets through to a point of the floor (factors 0..1): soft shadows of the window
/// and the lamp, and darkness about its foot.
[[nodiscard]] Light passed(const Eigen::Vector2d& p_world, const Blocker& blocker);
/// Nothing of a blocker is felt further away from its axis than this, m.
[[nodiscard]] double reach(const Blocker& blocker);
/// Colour (blue, green, red factors) of light: the window is cool, the lamp warm.
[[nodiscard]] Eigen::Array3f tint(const Light& light);

/// Light on the floor with all that stands on it for good, computed once on a grid.
class LightMap {
 public:
  /// Covers lower..upper (m, world); beyond it the edge's light goes on.
  LightMap(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper,
           const std::vector<Blocker>& blockers);
  [[nodiscard]] Light at(const Eigen::Vector2d& p_world) const;

 private:
  Eigen::Vector2d lower_;
  double step_;  // m
  int columns_, rows_;
  std::vector<Light> cells_;
};

}  // namespace slamscope::tracking::lab
