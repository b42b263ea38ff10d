// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "slam/simulation.hpp"

namespace slamscope::apps {

/// The simulation as the command line states it.
struct SimulationFlags {
  std::string world = "three-clusters";
  std::string sensor = "range-bearing";
  std::string update = "batch";
  std::vector<double> initial_sigma;  ///< x, y (m), θ (rad); empty: exactly known
  slam::SimulationOptions rest;       ///< what needs no translation

  /// Throws std::invalid_argument for a word that is not known.
  [[nodiscard]] slam::SimulationOptions options() const;
};

}  // namespace slamscope::apps
