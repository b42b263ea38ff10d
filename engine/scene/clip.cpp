// SPDX-License-Identifier: MIT
#include "engine/scene/clip.hpp"

#include <stdexcept>
#include <string>

namespace slamscope::engine {

Eigen::Matrix4d clipFromEye(const Pinhole& camera, double near) {
  if (camera.width <= 0 || camera.height <= 0) {
    throw std::invalid_argument("a camera's picture of " + std::to_string(camera.width) + " x " +
                                std::to_string(camera.height) + " px can't be drawn");
  }
  const double W = camera.width;
  const double H = camera.height;
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 0) = 2.0 * camera.fx / W;
  clip(0, 1) = 2.0 * camera.skew / W;
  clip(0, 2) = 2.0 * (camera.cx + 0.5) / W - 1.0;
  clip(1, 1) = 2.0 * camera.fy / H;
  clip(1, 2) = 2.0 * (camera.cy + 0.5) / H - 1.0;
  clip(2, 3) = near;
  clip(3, 2) = 1.0;
  return clip;
}

Eigen::Vector2d project(const Pinhole& camera, const Eigen::Vector3d& p_eye) {
  const double x = p_eye.x() / p_eye.z();
  const double y = p_eye.y() / p_eye.z();
  return {camera.fx * x + camera.skew * y + camera.cx, camera.fy * y + camera.cy};
}

}  // namespace slamscope::engine
