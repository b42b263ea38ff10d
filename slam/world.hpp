// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <string_view>
#include <vector>

#include "slam/snapshot.hpp"

namespace slamscope::slam {

enum class WorldKind { three_clusters, uniform, one_cluster };

/// `three-clusters`, `uniform`, `one-cluster`. The second throws std::invalid_argument on others.
[[nodiscard]] std::string_view worldName(WorldKind kind);
[[nodiscard]] WorldKind worldFromName(std::string_view name);

/// Point features on the floor in the frame of the map (origin: the robot's pose at the start, x
/// ahead). Ids count from 1, cluster by cluster.
struct World {
  std::vector<FeatureId> ids;
  std::vector<Eigen::Vector2d> features;  ///< m
};

/// A wall seen from above, in the frame of the map.
struct LaserWall {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    ///< m
  /// It sends a beam back only where the beam meets it squarely; any other comes back from nowhere.
  bool glossy = false;
};

/// The 1 m × 1 m loop has its centre here; all features stand within ±1.45 m of it in x and in y,
/// and at least 0.2 m off the loop.
inline const Eigen::Vector2d kLoopCentre{0.0, 0.5};

/// `count` features, the same for the same seed on every machine. Throws std::invalid_argument
/// unless count ≥ 1.
[[nodiscard]] World makeWorld(WorldKind kind, int count, std::uint64_t seed);

/// The robot's drive: a rest, then a number of counter-clockwise loops of 1 m × 1 m with rounded
/// corners, started in the middle of the lower side. Cut into time steps of constant velocity.
class LoopDrive {
 public:
  struct Options {
    int loops = 3;
    double rate = 10.0;   ///< time steps, 1/s
    double speed = 0.25;  ///< m/s, met within a few per cent: each piece is a whole number of steps
    double rest = 1.0;    ///< s
  };

  /// Throws std::invalid_argument unless loops ≥ 0, rate > 0, speed > 0, rest ≥ 0.
  explicit LoopDrive(const Options& options);

  [[nodiscard]] int stepCount() const { return static_cast<int>(velocities_.size()); }
  /// (forward m/s, turn rad/s) held from time step `step` to the next; step < stepCount().
  [[nodiscard]] Eigen::Vector2d velocity(int step) const { return velocities_.at(index(step)); }
  /// True pose (x, y, θ) at time step 0 … stepCount().
  [[nodiscard]] const Eigen::Vector3d& pose(int step) const { return poses_.at(index(step)); }
  /// True pose at any time; held before the start and after the end.
  [[nodiscard]] Eigen::Vector3d poseAt(std::chrono::nanoseconds time) const;
  [[nodiscard]] std::chrono::nanoseconds timeOf(int step) const;

 private:
  static std::size_t index(int step) { return static_cast<std::size_t>(step); }

  double rate_;
  std::vector<Eigen::Vector2d> velocities_;
  std::vector<Eigen::Vector3d> poses_;
};

}  // namespace slamscope::slam
