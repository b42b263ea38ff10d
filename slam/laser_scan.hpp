// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstddef>
#include <vector>

namespace slamscope::slam {

/// One sweep of a 2D laser. Return k was measured at angle_min + k angle_step, and at `time` + k
/// LaserMount::sweep / (count − 1).
struct LaserScan {
  std::chrono::nanoseconds time{};  ///< of the first return
  double angle_min = 0.0;           ///< rad, left positive, 0 ahead of the laser
  double angle_step = 0.0;          ///< rad, not 0
  std::vector<double> ranges;       ///< m; NaN: no return
  std::vector<double> intensities;  ///< empty, or one a return, in the device's unit

  [[nodiscard]] double angle(std::size_t k) const {
    return angle_min + static_cast<double>(k) * angle_step;
  }
};

/// Where the laser sits on the robot, and how long a sweep takes.
struct LaserMount {
  Eigen::Vector3d pose_robot = Eigen::Vector3d::Zero();  ///< x, y (m), heading (rad)
  double sweep = 0.0;                                    ///< s
};

}  // namespace slamscope::slam
