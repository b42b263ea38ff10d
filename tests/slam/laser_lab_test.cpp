// SPDX-License-Identifier: MIT
// The paper's experiment with a real robot, re-staged: from raw scans to a map, with a spurious
// feature that comes and goes.
#include "slam/laser_lab.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "slam/audit/audit.hpp"
#include "slam/score.hpp"

namespace slamscope::slam {
namespace {

using namespace std::chrono_literals;

struct LabRun {
  explicit LabRun(const LaserLabOptions& options)
      : lab(options), run(lab.record(), lab.runOptions()) {}

  LaserLab lab;
  RecordingRun run;
};

/// Distance to the nearest post.
double offPosts(const LaserLab& lab, const Eigen::Vector2d& feature) {
  double nearest = 1e9;
  for (const Eigen::Vector2d& post : lab.posts().features) {
    nearest = std::min(nearest, (post - feature).norm());
  }
  return nearest;
}

TEST(LaserLab, MapsTheFivePostsFromRawScansWithoutIds) {
  LabRun it({.loops = 3, .seed = 3});
  const Scorer scorer(it.run.filter(), it.run.recording());
  while (it.run.step()) {
  }
  const EkfState& state = it.run.filter().state();
  ASSERT_EQ(state.featureCount(), 5);
  for (int k = 0; k < 5; ++k) {
    EXPECT_LT(offPosts(it.lab, state.x.segment<2>(Snapshot::row(k))), 0.05);
  }
  EXPECT_LT(*scorer.score().path_rms_aligned, 0.05);
}

TEST(LaserLab, ASpuriousFeatureOfTheGlossyWallComesUpTentativeAndGoesAway) {
  LabRun it({.loops = 2, .seed = 1});
  std::set<FeatureId> spurious;
  std::set<FeatureId> believed;
  SnapshotPtr last;
  const Subscription listening =
      it.run.filter().observe({Event::step}, [&](const SnapshotPtr& snapshot) {
        last = snapshot;
        for (std::size_t k = 0; k < snapshot->ids.size(); ++k) {
          if (offPosts(it.lab, snapshot->features[k]) < 0.3) continue;
          spurious.insert(snapshot->ids[k]);
          if (!snapshot->isTentative(snapshot->ids[k])) believed.insert(snapshot->ids[k]);
        }
      });
  while (it.run.step()) {
  }
  EXPECT_FALSE(spurious.empty());
  EXPECT_TRUE(believed.empty());
  EXPECT_EQ(last->featureCount(), 5) << "all of them are gone at the end";
  EXPECT_GE(it.run.mapCounters()->dropped, 1U);
}

TEST(LaserLab, WithoutGlossNothingIsSpurious) {
  LabRun it({.loops = 1, .seed = 1, .glossy = false});
  while (it.run.step()) {
  }
  EXPECT_EQ(it.run.mapCounters()->born, 5U);
}

TEST(LaserLab, TheFirstFigureShowsThreeFeaturesTheSecondAllAndASpuriousOne) {
  LabRun it({.loops = 1, .seed = 1});
  const auto at = [&](std::chrono::nanoseconds time) {
    while (it.run.nextTime().value_or(time + 1ns) <= time) it.run.step();
    return it.run.filter().snapshot();
  };
  EXPECT_EQ(at(2400ms).featureCount(), 3);
  EXPECT_TRUE(at(2400ms).tentative.empty());
  const Snapshot middle = at(9s);
  EXPECT_EQ(middle.featureCount(), 6);
  EXPECT_EQ(middle.tentative.size(), 1U);
}

TEST(LaserLab, TheAuditFindsNoFaultInTheCode) {
  LabRun it({.loops = 3, .seed = 2});
  Audit audit({}, it.run.header());
  const Subscription listening = audit.listen(it.run.filter());
  while (it.run.step()) {
  }
  EXPECT_GT(audit.report().records, 400U);
  EXPECT_FALSE(audit.report().found(FaultClass::code));
}

TEST(LaserLab, TheSameSeedGivesTheSameScans) {
  const Recording a = LaserLab({.seed = 7}).record();
  const Recording b = LaserLab({.seed = 7}).record();
  const Recording c = LaserLab({.seed = 8}).record();
  EXPECT_EQ(a.scans[5].ranges[100], b.scans[5].ranges[100]);
  EXPECT_NE(a.scans[5].ranges[100], c.scans[5].ranges[100]);
  EXPECT_THROW(LaserLab({.range_sigma = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::slam
