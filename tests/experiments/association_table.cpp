// SPDX-License-Identifier: MIT
#include "tests/experiments/association_table.hpp"

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <vector>

#include "slam/ambiguous_world.hpp"
#include "slam/parallel.hpp"
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

void runOnce(const AmbiguousWorldOptions& world, Association association, int hypotheses,
             AssociationTally& tally) {
  RecordingRun run(recordAmbiguousWorld(world), ambiguousWorldRun(world, association, hypotheses));
  const Scorer scorer(run.filter(), run.recording());
  while (run.step()) {
  }
  tally.paired += static_cast<double>(run.mapCounters().value_or(MapCounters{}).paired);
  tally.wrong += static_cast<double>(run.mispaired());
  tally.features += run.filter().state().featureCount();
  tally.paths.push_back(scorer.score().path_rms_aligned.value());
}

AssociationTally tallyOf(AmbiguousWorldOptions world, Association association,
                         const AssociationTableOptions& options, int hypotheses = 0) {
  AssociationTally total;
  std::mutex mutex;
  parallelFor(options.seeds, options.threads, [&](int k) {
    AmbiguousWorldOptions mine = world;
    mine.seed = static_cast<std::uint64_t>(k + 1);
    AssociationTally one;
    runOnce(mine, association, hypotheses, one);
    const std::lock_guard lock(mutex);
    total.paired += one.paired;
    total.wrong += one.wrong;
    total.features += one.features;
    total.paths.push_back(one.paths.front());
  });
  return total;
}

void printLine(const AmbiguousWorldOptions& world, const char* name, const AssociationTally& t) {
  std::printf("| %.2f | %.2f | %s | %.2f %% | %.1f of %d | %.3f | %d of %d |\n", world.spacing,
              world.turn_sigma, name, t.paired > 0.0 ? 100.0 * t.wrong / t.paired : 0.0,
              t.features / t.runs(), 2 * world.pairs, t.median(), t.lost(), t.runs());
  std::fflush(stdout);
}

}  // namespace

int printAssociationTable(const AssociationTableOptions& options) {
  std::printf(
      "| spacing m | turn sigma rad/√s | association | wrong pairings | features | path m, median "
      "RMS | "
      "lost |\n| --- | --- | --- | --- | --- | --- | --- |\n");
  int not_better = 0;
  for (const double spacing : {0.8, 0.5, 0.3}) {
    for (const double turn_sigma : {0.03, 0.1}) {
      AmbiguousWorldOptions world;
      world.spacing = spacing;
      world.turn_sigma = turn_sigma;
      const AssociationTally known = tallyOf(world, Association::known, options);
      const AssociationTally nearest = tallyOf(world, Association::nearest, options);
      const AssociationTally joint = tallyOf(world, Association::joint, options);
      const AssociationTally many = tallyOf(world, Association::joint, options, options.hypotheses);
      printLine(world, "known", known);
      printLine(world, "nearest", nearest);
      printLine(world, "joint", joint);
      printLine(world, "hypotheses", many);
      if (joint.wrong > nearest.wrong || joint.median() > nearest.median()) ++not_better;
    }
  }
  return not_better;
}

}  // namespace slamscope::slam::experiments
