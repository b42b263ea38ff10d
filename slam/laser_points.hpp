// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "slam/laser_scan.hpp"

namespace slamscope::slam {

/// What counts as a point feature in a scan: a pole, post or trunk that stands free.
struct LaserPointOptions {
  double min_range = 0.2;      ///< m; nearer returns are the robot itself
  double max_range = 80.0;     ///< m; from here on: no return
  double min_diameter = 0.02;  ///< m
  double max_diameter = 0.8;   ///< m
  /// Returns of one object differ by less than this in range (m) from one to the next.
  double gap = 0.35;
  /// What is seen right and left of a point feature lies farther away than it by this much (m).
  double clearance = 0.8;
  int fewest_returns = 2;
  double range_sigma = 0.03;  ///< m, of one return
  /// m, of the centre, along and across, whatever the scan says: trunks are no cylinders, posts
  /// lean, and two sides of one thing are not quite the same place.
  double shape_sigma = 0.05;
  /// Given: only what shines at least so brightly is a feature (reflectors), and all that does.
  std::optional<double> reflector_intensity{};
};

/// A point feature in the frame of the laser.
struct LaserPoint {
  Eigen::Vector2d z = Eigen::Vector2d::Zero();  ///< range (m) and bearing (rad) of its centre
  Eigen::Matrix2d R = Eigen::Matrix2d::Zero();  ///< covariance of z
  double diameter = 0.0;                        ///< m
  std::size_t first = 0;                        ///< its returns: `first` … `last`
  std::size_t last = 0;
};

/// Point features of a scan, in order of the returns. A free-standing group of returns whose width,
/// n returns at r Δβ each, is that of a pole. Its centre lies half a diameter behind its front: the
/// mean depth of a disc's visible side is (1 − π/4) radii, so r = r̄ + π/4 D/2. The bearing is the
/// middle of the group; each of its edges is known to a step of the scan.
[[nodiscard]] std::vector<LaserPoint> findPoints(const LaserScan& scan,
                                                 const LaserPointOptions& options);

/// Whether the scan looked past the place at `range`, `bearing` (in the laser's frame), within
/// ± `margin_bearing` (rad), and saw nothing until `margin_range` (m) behind it. False where
/// something stands there or before it, and outside of the scan. Where nothing at all came back it
/// did look past.
[[nodiscard]] bool seesPast(const LaserScan& scan, const LaserPointOptions& options, double range,
                            double bearing, double margin_range, double margin_bearing);

}  // namespace slamscope::slam
