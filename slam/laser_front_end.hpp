// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam/ekf_equations.hpp"
#include "slam/laser_points.hpp"
#include "slam/map_builder.hpp"

namespace slamscope::slam {

/// Makes range-bearing observations, as seen from the robot's origin at the time of the scan, out
/// of laser scans.
class LaserFrontEnd {
 public:
  /// Throws std::invalid_argument for numbers that make no sense.
  LaserFrontEnd(const LaserMount& mount, const LaserPointOptions& options);

  /// `velocity`: (forward m/s, turn rad/s) of the robot during the sweep, by which each feature is
  /// taken back from the time of its own returns to the scan's. Ids are 0.
  [[nodiscard]] std::vector<Observation> observations(const LaserScan& scan,
                                                      const Eigen::Vector2d& velocity) const;

  /// What `scan` would have seen. It refers to the scan, which must outlive it.
  [[nodiscard]] MapBuilder::View view(const LaserScan& scan) const;

 private:
  LaserMount mount_;
  LaserPointOptions options_;
};

/// Reading of a feature from the robot's origin, by a sensor that sits at `pose_robot` (x, y,
/// heading) and reads range and bearing `z`. Jacobian by z on request.
[[nodiscard]] Eigen::Vector2d readingFromRobot(const Eigen::Vector3d& pose_robot,
                                               const Eigen::Vector2d& z,
                                               Eigen::Matrix2d* J = nullptr);

}  // namespace slamscope::slam
