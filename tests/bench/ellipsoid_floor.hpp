// SPDX-License-Identifier: MIT
#pragma once

#include <random>

#include "engine/scene/glyphs.hpp"
#include "engine/scene/view.hpp"

namespace slamscope::engine {

/// From 3 m before and 2.6 m above the middle of the floor.
inline View overFloor(const Pinhole& camera) {
  const Eigen::Vector3d eye(0.0, -3.0, 2.6);
  const Eigen::Vector3d z = -eye.normalized();
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  View view;
  view.camera = camera;
  view.T_eye_scene.linear() << x.transpose(), z.cross(x).transpose(), z.transpose();
  view.T_eye_scene.translation() = -(view.T_eye_scene.linear() * eye);
  return view;
}

/// Ellipsoids, 6 to 54 px long at f = 900 px, over 3 m × 3 m of floor.
inline Scene ellipsoidFloor(int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  std::uniform_real_distribution<double> size(0.01, 0.09);
  Scene scene;
  for (int i = 0; i < count; ++i) {
    const double minor = 0.5 * size(random);
    const Eigen::AngleAxisd turn(place(random), Eigen::Vector3d::UnitZ());
    scene.ellipsoids.push_back(
        {{place(random), place(random), 0.0},
         turn.toRotationMatrix() * Eigen::Vector3d(size(random), minor, minor).asDiagonal(),
         {0.9F, 0.1F, 0.1F, 1.0F}});
  }
  return scene;
}

}  // namespace slamscope::engine
