// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tracking/camera_info.hpp"

namespace slamscope::tracking::lab {

/// Directions of a camera's rays, through OpenCV's undistortion at every corner of every pixel and
/// linear in between (off by about 1e-3 px where distortion is strong).
class Lens {
 public:
  /// Throws std::invalid_argument: no size, skew (OpenCV knows none), a wrong number of
  /// coefficients, or a distortion that can't be inverted in the picture.
  explicit Lens(const CameraInfo& camera);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Direction (x, y, 1), camera frame, of the point (column − 0.5 + fx, row − 0.5 + fy), 0 ≤ f ≤
  /// 1, OpenCV's pixel convention: f = 0.5 is the centre of the pixel.
  [[nodiscard]] Eigen::Vector3d direction(int column, int row, double fx, double fy) const {
    const Eigen::Vector2d* a = &corners_[static_cast<std::size_t>(row) * (width_ + 1) + column];
    const Eigen::Vector2d* b = a + width_ + 1;
    const Eigen::Vector2d xy =
        (1 - fy) * ((1 - fx) * a[0] + fx * a[1]) + fy * ((1 - fx) * b[0] + fx * b[1]);
    return {xy.x(), xy.y(), 1};
  }
  /// Direction of the upper left corner of a pixel; column and row up to width and height.
  [[nodiscard]] Eigen::Vector3d corner(int column, int row) const {
    const Eigen::Vector2d& xy = corners_[static_cast<std::size_t>(row) * (width_ + 1) + column];
    return {xy.x(), xy.y(), 1};
  }

 private:
  int width_, height_;
  std::vector<Eigen::Vector2d> corners_;  // (height + 1) × (width + 1)
};

/// Where points of the camera frame fall in its picture, by OpenCV. All must be in front of it.
[[nodiscard]] std::vector<Eigen::Vector2d> projectByOpenCv(
    const CameraInfo& camera, const std::vector<Eigen::Vector3d>& p_camera);

}  // namespace slamscope::tracking::lab
