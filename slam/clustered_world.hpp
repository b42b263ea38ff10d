// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "slam/reading_error.hpp"
#include "slam/recording.hpp"

namespace slamscope::slam {

/// A room like that of MR.CLAM: posts stand in clusters, 0.2 m from each other, a camera sees a
/// narrow piece of it, ranges err for seconds on end, and wheels slip when they turn. Clusters look
/// the same; what tells them apart is where the robot believes to be.
struct ClusteredWorldOptions {
  int clusters = 6;  ///< three posts in each of the first three, two in the others
  ReadingErrorOptions error{
      .range_sigma = 0.08, .range_share = 0.04, .bearing_sigma = 0.018, .memory = 3.0};
  double forward_sigma = 0.015;  ///< m after 1 s
  double turn_sigma = 0.02;      ///< rad after 1 s
  double slip_sigma = 0.12;      ///< rad after 1 rad turned
  double sensor_range = 5.0;     ///< m
  double half_angle = 0.4;       ///< rad, seen to each side
  double seen_share = 0.6;       ///< of posts in view, each time
  int duration_s = 900;
  std::uint64_t seed = 1;
};

/// What the robot records there: odometry ten times and sightings twice a second with their true
/// ids, truth.
[[nodiscard]] Recording recordClusteredWorld(const ClusteredWorldOptions& options);

}  // namespace slamscope::slam
