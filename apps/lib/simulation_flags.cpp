// SPDX-License-Identifier: MIT
#include "apps/lib/simulation_flags.hpp"

#include <stdexcept>

#include "slam/faults.hpp"

namespace slamscope::apps {

slam::SimulationOptions SimulationFlags::options() const {
  slam::SimulationOptions options = rest;
  options.world = slam::worldFromName(world);
  if (sensor == "relative-position") options.sensor = slam::Sensor::relative_position;
  if (update == "sequential") options.update = slam::UpdateMode::sequential;
  if (!initial_sigma.empty()) {
    if (initial_sigma.size() != 3) {
      throw std::invalid_argument("--initial-sigma takes three numbers: X,Y,THETA (m, m, rad)");
    }
    options.initial_sigma = Eigen::Vector3d(initial_sigma[0], initial_sigma[1], initial_sigma[2]);
  }
  static_cast<void>(slam::makeFault(
      options.fault, {.sensor = options.sensor, .features = {}}));  // names are checked here
  return options;
}

}  // namespace slamscope::apps
