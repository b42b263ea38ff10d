// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "slam/simulation.hpp"

namespace slamscope::apps {

/// The true world of a run, known before it is shown: what a synthetic lab is built from.
struct RunTruth {
  std::chrono::nanoseconds start{}, end{};
  std::vector<slam::FeatureId> ids;
  std::vector<Eigen::Vector2d> features;  ///< m, frame of the map
  /// True pose (x, y, θ) of the robot in the map, held before the start and after the end.
  std::function<Eigen::Vector3d(std::chrono::nanoseconds)> pose;
};

/// Reads a run through to its end for its truth; nothing where it carries none. Throws as
/// openDrawable.
[[nodiscard]] std::optional<RunTruth> truthOfRun(const std::string& path);

/// The same of a simulation, without running its filter.
[[nodiscard]] RunTruth truthOfSimulation(const slam::SimulationOptions& options);

}  // namespace slamscope::apps
