// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tracking/board.hpp"
#include "tracking/camera_info.hpp"
#include "tracking/rig.hpp"

namespace slamscope::tracking {

struct CameraCalibration {
  CameraInfo info;                 ///< plumb_bob
  double residual_px = 0;          ///< RMS distance over all points
  std::vector<double> picture_px;  ///< the same of each picture
  double sigma_focal_px = 0;       ///< of fx, by the residuals
  double coverage = 0;             ///< part of the picture in which points were seen, 0..1
  std::vector<std::string> hints;  ///< what would make it better
};

/// Intrinsics from pictures of a board (cv::calibrateCamera). Throws std::runtime_error, one line,
/// where they are too weak to go by: fewer than four pictures, points in less than a quarter of the
/// picture, a board that is never tilted, a focal length known to no better than 2 %.
[[nodiscard]] CameraCalibration calibrateCamera(const std::vector<BoardSight>& pictures, int width,
                                                int height);

struct StereoCalibration {
  CameraCalibration left, right;
  Rig rig;
  double residual_px = 0;          ///< RMS distance with one T_right_left for all pairs
  std::vector<double> picture_px;  ///< of each pair
};

/// Both cameras and T_right_left from pictures taken at the same moment; pairs in which either
/// doesn't see the board are left out beforehand. Throws as calibrateCamera does, saying which
/// camera, and where the two lists differ in length.
[[nodiscard]] StereoCalibration calibrateStereo(const std::vector<BoardSight>& left,
                                                const std::vector<BoardSight>& right, int width,
                                                int height);

}  // namespace slamscope::tracking
