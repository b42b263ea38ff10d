// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "engine/scene/view.hpp"

namespace slamscope::engine {

/// Projects eye coordinates (m; x right, y down, z forward) to Vulkan's clip space. OpenCV has
/// integer pixel coordinates at pixel centres, Vulkan at corners: x_ndc = 2 (u + 0.5) / W − 1.
/// Depth is reversed with an infinite far plane: near / z. Throws std::invalid_argument where width
/// or height is not positive.
[[nodiscard]] Eigen::Matrix4d clipFromEye(const Pinhole& camera, double near);

/// Pixel of a point in eye coordinates, OpenCV's convention; the point must be in front (z > 0).
[[nodiscard]] Eigen::Vector2d project(const Pinhole& camera, const Eigen::Vector3d& p_eye);

}  // namespace slamscope::engine
