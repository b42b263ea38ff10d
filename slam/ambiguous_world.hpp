// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "slam/recording.hpp"
#include "slam/run_recording.hpp"

namespace slamscope::slam {

/// A world to lose one's way in: posts in close pairs, a robot with poor odometry that sees many of
/// them at once. Taken one by one the nearest feature is often the pair's other; taken together
/// only one pairing fits.
struct AmbiguousWorldOptions {
  int pairs = 12;
  double spacing = 0.5;        ///< m, between the two of a pair
  double turn_sigma = 0.1;     ///< rad after 1 s of driving: what the odometry is off by
  double forward_sigma = 0.1;  ///< m after 1 s of driving
  Eigen::Vector2d sensor_sigma{0.05, 0.01};  ///< m, rad
  double sensor_range = 8.0;                 ///< m, in all directions ahead (180°)
  int loops = 2;                             ///< of a circle of 6 m radius
  std::uint64_t seed = 1;
};

/// What the robot records there: odometry, sightings once a second with their true ids, truth.
[[nodiscard]] Recording recordAmbiguousWorld(const AmbiguousWorldOptions& options);

/// How to run over it: the world's own noise, white as it is there. `hypotheses` with joint only.
[[nodiscard]] RecordingRunOptions ambiguousWorldRun(const AmbiguousWorldOptions& world,
                                                    Association association, int hypotheses = 0);

}  // namespace slamscope::slam
