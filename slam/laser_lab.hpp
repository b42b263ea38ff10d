// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam/run_recording.hpp"
#include "slam/world.hpp"

namespace slamscope::slam {

struct LaserLabOptions {
  int loops = 3;
  std::uint64_t seed = 1;
  bool glossy = true;         ///< a part of the wall is; false: nothing spurious
  double range_sigma = 0.03;  ///< m, of one return
  /// m: posts lean and the robot rocks, so that each scan cuts a post at a place of its own.
  double sway_sigma = 0.02;
  double forward_sigma = 0.02;  ///< m after 1 s of driving: what the odometry is off by
  double turn_sigma = 0.05;     ///< rad after 1 s of driving
};

/// The paper's experiment with a real robot (section 4), re-staged: five posts within 3 m × 3 m,
/// walls at the sides, a robot with a 2D laser that drives loops of 1 m × 1 m. In front of a glossy
/// piece of the wall the laser sees the spot that it meets squarely as a post of its own: the
/// paper's spurious feature (its figure 10). As the robot drives on, the scan looks past it.
class LaserLab {
 public:
  explicit LaserLab(const LaserLabOptions& options);

  [[nodiscard]] const World& posts() const { return posts_; }
  [[nodiscard]] double postRadius() const;  ///< m
  [[nodiscard]] const std::vector<LaserWall>& walls() const { return walls_; }
  [[nodiscard]] const LoopDrive& drive() const { return drive_; }

  /// What the robot records: odometry 20 times a second, 5 scans a second over 240° in half
  /// degrees, each swept in 20 ms, and the truth. The map's origin is where the robot starts.
  [[nodiscard]] Recording record() const;
  /// A filter without ids that suits it.
  [[nodiscard]] RecordingRunOptions runOptions() const;

 private:
  LaserLabOptions options_;
  World posts_;
  std::vector<LaserWall> walls_;
  LoopDrive drive_;
};

}  // namespace slamscope::slam
