// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "slam/simulation.hpp"
#include "slam/world.hpp"

namespace slamscope::slam {
class LaserLab;
}

namespace slamscope::apps {

/// The true world of a run, known before it is shown: what a synthetic lab is built from.
struct RunTruth {
  std::chrono::nanoseconds start{}, end{};
  std::vector<slam::FeatureId> ids;
  std::vector<Eigen::Vector2d> features;  ///< m, frame of the map
  /// True pose (x, y, θ) of the robot in the map, held before the start and after the end.
  std::function<Eigen::Vector3d(std::chrono::nanoseconds)> pose;
  std::vector<slam::LaserWall> walls{};  ///< of a laser lab
  double post_radius = 0.0;              ///< m; 0: not known
};

/// Reads a run through to its end for its truth; nothing where it carries none. Throws as
/// openDrawable.
[[nodiscard]] std::optional<RunTruth> truthOfRun(const std::string& path);

/// The same of a simulation, without running its filter.
[[nodiscard]] RunTruth truthOfSimulation(const slam::SimulationOptions& options);

/// The laser lab with that many loops and that seed.
[[nodiscard]] slam::LaserLab laserLabOf(const slam::SimulationOptions& options);
[[nodiscard]] RunTruth truthOfLaserLab(const slam::LaserLab& lab);

}  // namespace slamscope::apps
