// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace slamscope::tracking {

/// Lens models of ROS's camera_info: plumb_bob (k1 k2 p1 p2 k3), rational_polynomial
/// (k1 k2 p1 p2 k3 k4 k5 k6), equidistant (k1 k2 k3 k4, OpenCV's fisheye).
enum class DistortionModel { plumb_bob, rational_polynomial, equidistant };

/// Intrinsics of one camera, OpenCV's pixel convention (integer coordinates are pixel centres).
struct CameraInfo {
  std::string name = "camera";
  int width = 0, height = 0;                        ///< px
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();  ///< px
  DistortionModel model = DistortionModel::plumb_bob;
  std::vector<double> D;  ///< coefficients of `model`; empty: no distortion
};

/// Reads ROS's camera_info YAML (image_width, image_height, camera_name, camera_matrix,
/// distortion_model, distortion_coefficients):
///
///     image_width: 1280
///     image_height: 720
///     camera_name: overhead
///     camera_matrix: {rows: 3, cols: 3, data: [640, 0, 639.5, 0, 640, 359.5, 0, 0, 1]}
///     distortion_model: plumb_bob
///     distortion_coefficients: {rows: 1, cols: 5, data: [-0.1, 0.02, 0, 0, 0]}
///
/// Throws std::runtime_error naming file, field and what was expected.
[[nodiscard]] CameraInfo readCameraInfo(const std::filesystem::path& file);
/// Writes what readCameraInfo reads, doubles to the last digit. Throws where the file can't be
/// written.
void writeCameraInfo(const CameraInfo& info, const std::filesystem::path& file);

/// Throws std::runtime_error ("camera info is for 640 x 480, the frames are 1280 x 720") where the
/// frames are not of the size the camera was calibrated at.
void requireSize(const CameraInfo& info, int frame_width, int frame_height);

/// Intrinsics for a camera nobody calibrated: no distortion, principal point in the middle of the
/// picture, horizontal field of view 60 degrees. Good enough to see something; call it
/// uncalibrated.
[[nodiscard]] CameraInfo guessedCameraInfo(int width, int height);

/// The pinhole camera of the undistorted picture: same K without skew, no distortion. With a size,
/// K is scaled to it (pixel centres at integers: cx' = (cx + 0.5) s − 0.5), filling the smaller
/// ratio.
[[nodiscard]] CameraInfo idealPinhole(const CameraInfo& info);
[[nodiscard]] CameraInfo idealPinhole(const CameraInfo& info, int width, int height);

}  // namespace slamscope::tracking
