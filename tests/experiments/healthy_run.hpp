// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "slam/simulation.hpp"

namespace slamscope::slam::experiments {

/// A run of a correct filter, and how its log differs from what our own program would write.
struct HealthyRun {
  SimulationOptions simulation;
  std::string variant = "plain";  ///< see tests/slam/variants/variants.hpp
  int max_steps = 1 << 30;        ///< time steps after which the run is cut off
  bool removal = false;           ///< features are taken out now and then, and come back
  bool millimetres = false;
  bool unwrapped = false;  ///< headings

  [[nodiscard]] std::string describe() const;
};

/// The run of this number: world, map of 2 to 300 features, noises, motion input, sensor, start
/// pose, kind of update, lawful variant and units are drawn from it.
[[nodiscard]] HealthyRun drawHealthyRun(std::uint64_t number);

/// Runs it and hands on header and snapshots.
void runHealthy(const HealthyRun& run, const std::function<void(const RunHeader&)>& begin,
                const std::function<void(const SnapshotPtr&)>& hear);

}  // namespace slamscope::slam::experiments
