// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "tracking/camera_info.hpp"

namespace slamscope::tracking {

/// J_uv_p: derivative of a pixel by a point of the camera frame, px / m.
using PixelJacobian = Eigen::Matrix<double, 2, 3>;

/// Pinhole camera with lens distortion as OpenCV defines it (cv::projectPoints, cv::fisheye),
/// checked against OpenCV to 1e-9 px. Camera frame: x right, y down, z forward. Pixels: integer
/// coordinates are pixel centres.
///
/// Valid set: points in front of the camera (z > 0; equidistant: angle to the axis under 180
/// degrees) whose angle to the optical axis lies below the first maximum of the radial distortion,
/// where the polynomial stops meaning anything (points beyond it fold back into the picture).
/// Whether the pixel lies inside the picture is not asked.
class CameraModel {
 public:
  /// Throws std::invalid_argument where the size is not positive, K is not upper triangular with
  /// positive focal lengths and 1 in the corner, or the number of coefficients doesn't fit the
  /// model.
  explicit CameraModel(CameraInfo info);

  [[nodiscard]] const CameraInfo& info() const { return info_; }
  [[nodiscard]] const Eigen::Matrix3d& K() const { return info_.K; }
  /// Nothing but K between ray and pixel.
  [[nodiscard]] bool undistorted() const { return undistorted_; }
  /// Largest angle to the optical axis of the valid set, rad.
  [[nodiscard]] double maxAngle() const { return max_angle_; }

  /// Pixel of a point of the camera frame (m), nothing outside of the valid set.
  [[nodiscard]] std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_camera,
                                                       PixelJacobian* J_uv_p = nullptr) const;
  /// Unit vector of the camera frame that projects to the pixel, nothing where none of the valid
  /// set does.
  [[nodiscard]] std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& px) const;

 private:
  CameraInfo info_;
  std::vector<double> D_;  // padded: 8 coefficients, or 4 for equidistant
  bool undistorted_ = false;
  double max_angle_ = 0;
  double max_radius_squared_ = 0;  // tan² of it, of x/z, y/z
};

}  // namespace slamscope::tracking
