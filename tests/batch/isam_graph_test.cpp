// SPDX-License-Identifier: MIT
#include "slam/formats/isam_graph.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "slam/run_recording.hpp"
#include "slam/score.hpp"
#include "tests/batch/batch_graph.hpp"

namespace slamscope::slam {
namespace {

namespace fs = std::filesystem;

double rmsAligned(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b) {
  const Alignment aligned = alignRigid(a, b);
  double squared = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) squared += (aligned(a[k]) - b[k]).squaredNorm();
  return std::sqrt(squared / static_cast<double>(a.size()));
}

struct Ending {
  double rms;       ///< m, of the filter's map against the batch solution
  double mirrored;  ///< the same of a map that is wrong
};

/// Victoria Park with the ids that others gave its trees: the map of one filter pass beside that of
/// all readings at once.
Ending endOf(const Recording& recording, bool first_estimates) {
  RecordingRunOptions options;
  options.gate_probability.reset();
  options.first_estimates = first_estimates;
  RecordingRun run(recording, options);
  testing::BatchGraph batch(recording);
  const auto subscription = run.filter().observe(
      {Event::step, Event::predict}, [&](const SnapshotPtr& snapshot) { batch.start(*snapshot); });
  while (run.step()) {
  }
  Snapshot last = run.filter().snapshot();
  EXPECT_EQ(last.featureCount(), 151);
  batch.solve();
  EXPECT_LT(batch.finalCost(), batch.initialCost());
  EXPECT_LT(batch.finalCost(), 3500.0) << "half of chi squared, of 6975 degrees of freedom";
  std::vector<Eigen::Vector2d> solved;
  for (const FeatureId id : last.ids) solved.push_back(batch.feature(id));
  const double rms = rmsAligned(last.features, solved);
  for (Eigen::Vector2d& feature : last.features) feature.y() = -feature.y();
  return {rms, rmsAligned(last.features, solved)};
}

TEST(IsamGraph, FilterEndsNearTheBatchSolution) {
  const char* given = std::getenv("SLAMSCOPE_DATA");
  const fs::path file =
      (given != nullptr ? fs::path(given) : fs::path(SLAMSCOPE_SOURCE_DIR) / "../shared/data") /
      "victoria_park_isam" / "victoriaPark.txt";
  if (!fs::exists(file)) GTEST_SKIP() << "no recorded data: " << file;
  const Recording recording = readIsamGraph(file);
  ASSERT_EQ(recording.odometry.size(), 6969U);
  const Ending first = endOf(recording, true);
  EXPECT_LT(first.rms, 1.0);
  EXPECT_GT(first.mirrored, 1.0) << "must fail";
  // The EKF's known inconsistency: sure of a heading that it can't know, it bends this map by
  // metres.
  const Ending newest = endOf(recording, false);
  EXPECT_LT(newest.rms, 5.0);
  EXPECT_GT(newest.rms, first.rms);
}

}  // namespace
}  // namespace slamscope::slam
