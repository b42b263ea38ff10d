// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "tracking/registration.hpp"

namespace slamscope::tracking {

/// Covariance of the right perturbation of T_camera_world (translation, rotation; world axes) of a
/// camera whose place and direction are uncertain about its own centre.
[[nodiscard]] Matrix6d cameraCovariance(const CameraPose& pose);

/// Root mean square error over the floor in view, in the picture (px) and on the floor (m).
struct PredictedError {
  double overlay_px = 0, floor_m = 0;
};
[[nodiscard]] PredictedError predictError(const CameraModel& camera,
                                          const RegistrationResult& registration, double extent_m);

/// Where the robot's tag, seen by a known camera, puts the map when held to its plane: rays of its
/// corners met with the heights the corners are known to have, then the planar motion that fits
/// best.
struct PlanarStart {
  Eigen::Isometry3d T_world_map = Eigen::Isometry3d::Identity();
  double scale = 1;  ///< how much larger than stated the tag looks
};
[[nodiscard]] std::optional<PlanarStart> planarStart(const CameraModel& camera,
                                                     const Eigen::Isometry3d& T_camera_world,
                                                     const RobotTag& robot,
                                                     const TagDetection& seen);

}  // namespace slamscope::tracking
