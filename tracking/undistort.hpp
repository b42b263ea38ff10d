// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tracking/camera_info.hpp"

namespace slamscope::tracking {

/// Where each pixel of an undistorted picture is found in the camera's own picture.
struct UndistortMap {
  int width = 0, height = 0;  ///< of the undistorted picture, px
  /// u, v of the source pixel for each output pixel, rows from the top, tightly packed, OpenCV's
  /// convention (0, 0 = centre of the first pixel). kNowhere where the lens model has no answer.
  std::vector<float> uv;
  static constexpr float kNowhere = -1e6F;
};

/// The map from the pinhole picture (K without distortion, width × height) to the picture of
/// `source`, projected exactly for every pixel. K must be upper triangular, else
/// std::invalid_argument.
[[nodiscard]] UndistortMap undistortMap(const CameraInfo& source, const Eigen::Matrix3d& K,
                                        int width, int height);
/// The same with K and size of `pinhole`.
[[nodiscard]] UndistortMap undistortMap(const CameraInfo& source, const CameraInfo& pinhole);

}  // namespace slamscope::tracking
