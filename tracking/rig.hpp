// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "tracking/camera_info.hpp"

namespace slamscope::tracking {

/// Lens between one half of the display and its eye. Such lenses magnify the more the further from
/// their axis (pincushion); the picture is shrunk there beforehand so that the two cancel.
/// Lengths in units of half the eye's picture *height*, from the lens's axis.
struct DisplayLens {
  /// Where the axis meets the eye's picture, parts of its width and height from the upper left.
  Eigen::Vector2d centre{0.5, 0.5};
  /// At distance r of the display the picture's point at r (1 + k1 r² + k2 r⁴ + k3 r⁶) / zoom is
  /// shown.
  std::array<double, 3> k{};
  double zoom = 1;
  /// The same, times this, for blue, green, red: takes off the lens's coloured fringes.
  std::array<double, 3> colour_scale{1, 1, 1};

  /// Shows the picture as it is.
  [[nodiscard]] bool plain() const;
  bool operator==(const DisplayLens&) const = default;
};

/// Which point of the eye's picture (px, OpenCV's convention) is shown at a point of the display
/// (px, same size, same convention), for channel 0 blue, 1 green, 2 red.
[[nodiscard]] Eigen::Vector2d shownAt(const DisplayLens& lens, const Eigen::Vector2d& display_px,
                                      int width, int height, int channel);

/// One of the head's cameras.
struct RigCamera {
  CameraInfo info;
  /// Rolling shutter: from the exposure of the first row to that of the last; 0: all at once.
  std::chrono::nanoseconds readout{0};
  /// What is added to a frame's stamp to get its true mid-exposure (of the middle row).
  std::chrono::nanoseconds time_offset{0};
  std::chrono::nanoseconds time_sigma{0};  ///< how well that is known
  DisplayLens display;                     ///< of the eye that sees this camera's picture
};

/// The cameras on a head: one, or left and right. Frames `left`, `right`: optical (x right, y down,
/// z forward). Frame `head`: whatever T_head_left says; the left camera's unless it is given.
struct Rig {
  std::string name = "rig";
  bool calibrated = true;          ///< false: guessed (see guessedRig); to be shown to the user
  std::vector<RigCamera> cameras;  ///< 0 the left (or only) one, 1 the right one
  Eigen::Isometry3d T_right_left = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_head_left = Eigen::Isometry3d::Identity();

  /// Throws std::out_of_range for a camera that the rig doesn't have.
  [[nodiscard]] Eigen::Isometry3d T_head_camera(std::size_t camera) const;
  /// Distance of the two cameras, m.
  [[nodiscard]] double baseline() const { return T_right_left.translation().norm(); }
};

/// Mid-exposure of a row (px, from −0.5 to height − 0.5) of a frame whose middle row is exposed at
/// `time` (the stamp with the camera's time_offset added already).
[[nodiscard]] std::chrono::nanoseconds rowTime(const RigCamera& camera,
                                               std::chrono::nanoseconds time, double row);

/// Reads rig.yaml:
///
///     name: two webcams
///     T_right_left: {position_m: [-0.064, 0, 0], rpy_deg: [0, 0.4, 0]}   # with two cameras
///     T_head_left: {position_m: [-0.032, 0, 0]}                # optional
///     left:
///       camera_info: left.yaml          # ROS's camera_info, found beside this file, or its fields
///                                       # in place (image_width, camera_matrix, …)
///       readout_s: 0.021                # optional, 0
///       time_offset_s: -0.004           # optional, 0
///       time_sigma_s: 0.001             # optional, 0
///       display: {centre: [0.5, 0.5], k: [0.22, 0.24, 0], zoom: 1, colour_scale: [1, 1, 1]}
///     right: …                          # absent: one camera
///
/// Throws std::runtime_error naming file, field and what was expected.
[[nodiscard]] Rig readRig(const std::filesystem::path& file);
/// Writes what readRig reads, camera_info in place, to the last digit.
void writeRig(const Rig& rig, const std::filesystem::path& file);

/// A rig that nobody calibrated: guessedCameraInfo, eyes 64 mm apart and parallel. Not calibrated.
[[nodiscard]] Rig guessedRig(int width, int height, std::size_t cameras);

}  // namespace slamscope::tracking
