// SPDX-License-Identifier: MIT
#include "tests/experiments/association_table.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "slam/ambiguous_world.hpp"
#include "slam/clustered_world.hpp"
#include "slam/parallel.hpp"
#include "slam/recording_defaults.hpp"
#include "slam/run_recording.hpp"
#include "slam/score.hpp"

namespace slamscope::slam::experiments {
namespace {

/// Sums over the runs of a line.
struct AssociationTally {
  double paired = 0.0;
  double wrong = 0.0;
  double features = 0.0;
  std::vector<double> paths;  ///< RMS of each run, m

  [[nodiscard]] int runs() const { return static_cast<int>(paths.size()); }
  /// Runs whose path is off by more than a metre.
  [[nodiscard]] int lost() const {
    return static_cast<int>(
        std::count_if(paths.begin(), paths.end(), [](double path) { return path > 1.0; }));
  }
  [[nodiscard]] double median() const {
    std::vector<double> sorted = paths;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

struct Drive {
  Recording recording;
  RecordingRunOptions options;
};

/// The drive of a seed.
using Draw = std::function<Drive(std::uint64_t)>;

AssociationTally tallyOf(const Draw& draw, const AssociationTableOptions& options) {
  AssociationTally total;
  std::mutex mutex;
  parallelFor(options.seeds, options.threads, [&](int k) {
    Drive drive = draw(static_cast<std::uint64_t>(k + 1));
    RecordingRun run(std::move(drive.recording), drive.options);
    const Scorer scorer(run.filter(), run.recording());
    while (run.step()) {
    }
    const std::lock_guard lock(mutex);
    total.paired += static_cast<double>(run.mapCounters().value_or(MapCounters{}).paired);
    total.wrong += static_cast<double>(run.mispaired());
    total.features += run.filter().state().featureCount();
    total.paths.push_back(scorer.score().path_rms_aligned.value());
  });
  return total;
}

Draw ambiguousDrives(const AmbiguousWorldOptions& world, Association association, int hypotheses) {
  return [=](std::uint64_t seed) {
    AmbiguousWorldOptions mine = world;
    mine.seed = seed;
    return Drive{recordAmbiguousWorld(mine), ambiguousWorldRun(mine, association, hypotheses)};
  };
}

Draw clusteredDrives(Association association, int hypotheses) {
  return [=](std::uint64_t seed) {
    const Recording recording = recordClusteredWorld({.seed = seed});
    return Drive{recording, usualOptions(recording, association, hypotheses)};
  };
}

void printTally(const std::string& world, const char* name, const AssociationTally& t,
                int features) {
  std::printf("| %s | %s | %.2f %% | %.1f of %d | %.3f | %d of %d |\n", world.c_str(), name,
              t.paired > 0.0 ? 100.0 * t.wrong / t.paired : 0.0, t.features / t.runs(), features,
              t.median(), t.lost(), t.runs());
  std::fflush(stdout);
}

/// Prints the lines of one world; whether joint is better than nearest there.
bool printWorld(const std::string& world, int features, const AssociationTableOptions& options,
                const std::function<Draw(Association, int)>& drives) {
  const AssociationTally nearest = tallyOf(drives(Association::nearest, 0), options);
  const AssociationTally joint = tallyOf(drives(Association::joint, 0), options);
  printTally(world, "known", tallyOf(drives(Association::known, 0), options), features);
  printTally(world, "nearest", nearest, features);
  printTally(world, "joint", joint, features);
  printTally(world, "hypotheses", tallyOf(drives(Association::joint, options.hypotheses), options),
             features);
  return joint.wrong <= nearest.wrong && joint.median() <= nearest.median();
}

}  // namespace

int printAssociationTable(const AssociationTableOptions& options) {
  std::printf(
      "| spacing m | turn sigma rad/√s | association | wrong pairings | features | path m, median "
      "RMS | lost |\n| --- | --- | --- | --- | --- | --- | --- |\n");
  int not_better = 0;
  for (const double spacing : {0.8, 0.5, 0.3}) {
    for (const double turn_sigma : {0.03, 0.1}) {
      AmbiguousWorldOptions world;
      world.spacing = spacing;
      world.turn_sigma = turn_sigma;
      char name[32];
      std::snprintf(name, sizeof name, "%.2f | %.2f", spacing, turn_sigma);
      const auto drives = [&](Association association, int hypotheses) {
        return ambiguousDrives(world, association, hypotheses);
      };
      if (!printWorld(name, 2 * world.pairs, options, drives)) ++not_better;
    }
  }
  if (!printWorld("clusters | 0.02 and slip", 15, options, clusteredDrives)) ++not_better;
  return not_better;
}

}  // namespace slamscope::slam::experiments
