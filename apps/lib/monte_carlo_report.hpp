// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "slam/monte_carlo.hpp"

namespace slamscope::apps {

/// A table of ANEES and NIS with their two-sided bands, in words of what they say.
[[nodiscard]] std::string monteCarloText(const slam::MonteCarloResult& result,
                                         const slam::SimulationOptions& simulation);

/// The same with every time step.
[[nodiscard]] std::string monteCarloJson(const slam::MonteCarloResult& result,
                                         const slam::SimulationOptions& simulation);

}  // namespace slamscope::apps
