// SPDX-License-Identifier: MIT
#include "apps/slamscope/flags.hpp"

#include <cstdio>

#include "slam/faults.hpp"

namespace slamscope::apps {

void addSimulationFlags(CLI::App& verb, SimulationFlags& flags) {
  const std::string group = "Simulation";
  slam::SimulationOptions& rest = flags.rest;
  verb.add_option("--world", flags.world, "three-clusters, uniform or one-cluster")
      ->check(CLI::IsMember({"three-clusters", "uniform", "one-cluster"}))
      ->group(group);
  verb.add_option("--features", rest.features, "how many features")
      ->check(CLI::Range(1, 5000))
      ->group(group);
  verb.add_option("--loops", rest.loops, "times round the 1 m x 1 m loop")
      ->check(CLI::Range(0, 10000))
      ->group(group);
  verb.add_option("--seed", rest.seed, "of world and noise; the same seed gives the same run")
      ->group(group);
  verb.add_option("--fault", rest.fault, "programming fault planted in the filter (--list-faults)")
      ->group(group);
  verb.add_option("--fault-features", rest.fault_features,
                  "ids of the features that the fault `paper` spoils")
      ->delimiter(',')
      ->group(group);
  verb.add_option("--initial-sigma", flags.initial_sigma,
                  "X,Y,THETA: sigma of the start pose (m, m, rad); default: exactly known")
      ->delimiter(',')
      ->expected(3)
      ->group(group);
  verb.add_option("--sensor", flags.sensor, "range-bearing or relative-position")
      ->check(CLI::IsMember({"range-bearing", "relative-position"}))
      ->group(group);
  verb.add_option("--update", flags.update, "all observations of a step at once, or one by one")
      ->check(CLI::IsMember({"batch", "sequential"}))
      ->group(group);
}

void listFaults() {
  for (const slam::FaultDescription& fault : slam::faultNames()) {
    std::printf("%-28.*s %.*s\n", static_cast<int>(fault.name.size()), fault.name.data(),
                static_cast<int>(fault.description.size()), fault.description.data());
  }
}

}  // namespace slamscope::apps
