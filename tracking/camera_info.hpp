// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace slamscope::tracking {

/// Lens models of ROS's camera_info: plumb_bob (k1 k2 p1 p2 k3), rational_polynomial
/// (k1 k2 p1 p2 k3 k4 k5 k6), equidistant (k1 k2 k3 k4, OpenCV's fisheye).
enum class DistortionModel { plumb_bob, rational_polynomial, equidistant };

/// Intrinsics of one camera, OpenCV's pixel convention (integer coordinates are pixel centres).
struct CameraInfo {
  std::string name = "camera";
  int width = 0, height = 0;  ///< px
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();  ///< px
  DistortionModel model = DistortionModel::plumb_bob;
  std::vector<double> D;  ///< coefficients of `model`; empty: no distortion
};

/// Reads ROS's camera_info YAML (image_width, image_height, camera_name, camera_matrix,
/// distortion_model, distortion_coefficients). Throws std::runtime_error naming file, field and what
/// was expected.
[[nodiscard]] CameraInfo readCameraInfo(const std::filesystem::path& file);
void writeCameraInfo(const CameraInfo& info, const std::filesystem::path& file);

}  // namespace slamscope::tracking
