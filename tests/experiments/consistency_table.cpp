// SPDX-License-Identifier: MIT
#include "tests/experiments/consistency_table.hpp"

#include <cstdio>

#include "slam/monte_carlo.hpp"

namespace slamscope::slam::experiments {
namespace {

void printConsistency(const Consistency& c) {
  std::printf(" | %.3f (%.3f to %.3f)%s", c.mean, c.low, c.high, c.inside() ? "" : " **out**");
}

}  // namespace

int printConsistencyTable(const ConsistencyTableOptions& options) {
  std::printf(
      "| sensor | motion | update | mean NIS / dof (99 %% band) | ANEES pose / dof | ANEES map / "
      "dof "
      "|\n| --- | --- | --- | --- | --- | --- |\n");
  int outside = 0;
  for (const Sensor sensor : {Sensor::range_bearing, Sensor::relative_position}) {
    for (const MotionInput motion : {MotionInput::velocity, MotionInput::increment}) {
      for (const UpdateMode update : {UpdateMode::batch, UpdateMode::sequential}) {
        MonteCarloOptions monte_carlo;
        monte_carlo.runs = options.runs;
        monte_carlo.threads = options.threads;
        monte_carlo.confidence = 0.99;
        monte_carlo.simulation.sensor = sensor;
        monte_carlo.simulation.motion = motion;
        monte_carlo.simulation.update = update;
        monte_carlo.simulation.loops = options.loops;
        const MonteCarloResult result = runMonteCarlo(monte_carlo);
        std::printf("| %s | %s | %s",
                    sensor == Sensor::range_bearing ? "range-bearing" : "relative-position",
                    motion == MotionInput::velocity ? "velocity" : "increment",
                    update == UpdateMode::batch ? "batch" : "sequential");
        printConsistency(result.nis);
        printConsistency(result.pose);
        printConsistency(result.features);
        std::printf(" |\n");
        std::fflush(stdout);
        outside += result.nis.inside() ? 0 : 1;
      }
    }
  }
  return outside;
}

}  // namespace slamscope::slam::experiments
