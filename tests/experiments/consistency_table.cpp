// SPDX-License-Identifier: MIT
#include "tests/experiments/consistency_table.hpp"

#include <cstdio>
#include <memory>

#include "slam/laser_lab.hpp"
#include "slam/monte_carlo.hpp"

namespace slamscope::slam::experiments {
namespace {

void printConsistency(const Consistency& c) {
  std::printf(" | %.3f (%.3f to %.3f)%s", c.mean, c.low, c.high, c.inside() ? "" : " **out**");
}

/// Returns whether the NIS is outside.
int printConsistencyLine(const char* sensor, const char* motion, const char* update,
                         const MonteCarloResult& result) {
  std::printf("| %s | %s | %s", sensor, motion, update);
  printConsistency(result.nis);
  printConsistency(result.pose);
  printConsistency(result.features);
  std::printf(" |\n");
  std::fflush(stdout);
  return result.nis.inside() ? 0 : 1;
}

const char* motionName(MotionInput motion) {
  switch (motion) {
    case MotionInput::velocity:
      return "velocity";
    case MotionInput::increment:
      return "increment";
    case MotionInput::ackermann:
      break;
  }
  return "Ackermann";
}

MonteCarloOptions monteCarlo(const ConsistencyTableOptions& options) {
  MonteCarloOptions monte_carlo;
  monte_carlo.runs = options.runs;
  monte_carlo.threads = options.threads;
  monte_carlo.confidence = 0.99;
  monte_carlo.simulation.loops = options.loops;
  return monte_carlo;
}

int printSimulated(const ConsistencyTableOptions& options) {
  int outside = 0;
  for (const Sensor sensor : {Sensor::range_bearing, Sensor::relative_position}) {
    for (const MotionInput motion :
         {MotionInput::velocity, MotionInput::increment, MotionInput::ackermann}) {
      for (const UpdateMode update : {UpdateMode::batch, UpdateMode::sequential}) {
        MonteCarloOptions monte_carlo = monteCarlo(options);
        monte_carlo.simulation.sensor = sensor;
        monte_carlo.simulation.motion = motion;
        monte_carlo.simulation.update = update;
        outside += printConsistencyLine(
            sensor == Sensor::range_bearing ? "range-bearing" : "relative-position",
            motionName(motion), update == UpdateMode::batch ? "batch" : "sequential",
            runMonteCarlo(monte_carlo));
      }
    }
  }
  return outside;
}

/// The snapshot with the posts as its truth, each called as the feature that is nearest to it.
SnapshotPtr withPosts(const Snapshot& snapshot, const World& posts) {
  auto named = std::make_shared<Snapshot>(snapshot);
  for (std::size_t k = 0; k < snapshot.ids.size(); ++k) {
    const Eigen::Vector2d* nearest = &posts.features.front();
    for (const Eigen::Vector2d& post : posts.features) {
      const Eigen::Vector2d& feature = snapshot.features[k];
      if ((post - feature).norm() < (*nearest - feature).norm()) nearest = &post;
    }
    named->truth->ids.push_back(snapshot.ids[k]);
    named->truth->features.push_back(*nearest);
  }
  return named;
}

/// From raw scans: posts are found and paired without ids. The gate is wide, because the NIS of
/// what passes a narrow one is small by construction.
int printLaser(const ConsistencyTableOptions& options) {
  MonteCarloOptions monte_carlo = monteCarlo(options);
  monte_carlo.simulation.features = 5;
  const auto drive = [&](std::uint64_t seed, const Subject::Callback& listener) {
    const LaserLab lab({.loops = options.loops, .seed = seed, .glossy = false});
    RecordingRunOptions run_options = lab.runOptions();
    run_options.gates = {.pair = 0.999999, .fresh = 0.9999999};
    run_options.record_jacobians = true;
    RecordingRun run(lab.record(), run_options);
    const Subscription subscription = run.filter().observe(
        [&](const SnapshotPtr& snapshot) { listener(withPosts(*snapshot, lab.posts())); });
    while (run.step()) {
    }
  };
  return printConsistencyLine("laser", "velocity", "batch", runMonteCarlo(monte_carlo, drive));
}

}  // namespace

int printConsistencyTable(const ConsistencyTableOptions& options) {
  std::printf(
      "| sensor | motion | update | mean NIS / dof (99 %% band) | ANEES pose / dof | ANEES map / "
      "dof "
      "|\n| --- | --- | --- | --- | --- | --- |\n");
  return printSimulated(options) + printLaser(options);
}

}  // namespace slamscope::slam::experiments
