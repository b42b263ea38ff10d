// SPDX-License-Identifier: MIT
#include "slam/faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "slam/correlation.hpp"
#include "slam/correlation_pairs.hpp"
#include "slam/simulation.hpp"
#include "tests/slam/laws.hpp"

namespace slamscope::slam {
namespace {

struct Growth {
  int pair_steps = 0;
  std::vector<std::pair<FeatureId, FeatureId>> grown;  ///< pairs whose P_d grew in an update
  std::vector<ClusterPair> start;                      ///< when all features were found first
  std::vector<ClusterPair> end;
  bool finite = true;
  double least_eigenvalue = 1.0;
};

Growth watch(const std::string& fault) {
  Simulation simulation({.fault = fault});
  Growth growth;
  SnapshotPtr before;
  ClusterTracker tracker;
  const Subscription subscription = simulation.filter().observe([&](const SnapshotPtr& s) {
    growth.finite = growth.finite && s->finite();
    if (before && s->event == Event::update) {
      for (const FeaturePair& now : selectPairs(*s, PairMode::all, {}).pairs) {
        const Eigen::Matrix2d D = relativeCovariance(*before, now.i, now.j) - now.P_d;
        ++growth.pair_steps;
        if (principalAxes(D).eigenvalues[1] < -1e-14) {
          growth.grown.emplace_back(s->ids[static_cast<std::size_t>(now.i)],
                                    s->ids[static_cast<std::size_t>(now.j)]);
        }
      }
    }
    before = s;
    if (s->event != Event::step) return;
    growth.least_eigenvalue =
        std::min(growth.least_eigenvalue, testing::scaledLeastEigenvalue(s->covariance.dense()));
    growth.end = selectPairs(*s, PairMode::min_mean_max, tracker.update(*s)).cluster_pairs;
    if (growth.start.empty() && s->ids.size() == 15) growth.start = growth.end;
  });
  while (simulation.step()) {
  }
  return growth;
}

TEST(FaultPaper, NoPairGrowsWithoutIt) {
  const Growth growth = watch("none");
  EXPECT_GT(growth.pair_steps, 20000);
  EXPECT_TRUE(growth.grown.empty());
  ASSERT_EQ(growth.end.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LT(ellipseArea(growth.end[k].maximum.P_d),
              0.6 * ellipseArea(growth.start[k].maximum.P_d));
  }
}

TEST(FaultPaper, GrowsPairsOfCertainFeaturesOnly) {
  const Growth growth = watch("paper");
  ASSERT_FALSE(growth.grown.empty());
  const auto faulty = [](FeatureId id) { return id == 2 || id == 8 || id == 14; };
  for (const auto& [a, b] : growth.grown) EXPECT_TRUE(faulty(a) || faulty(b)) << a << ' ' << b;
  EXPECT_TRUE(growth.finite);
  EXPECT_GE(growth.least_eigenvalue, -1e-12) << "the fault must not be seen from P's sign alone";
}

TEST(FaultPaper, LooksAsThePaperSays) {
  const Growth growth = watch("paper");
  ASSERT_EQ(growth.start.size(), 3U);
  ASSERT_EQ(growth.end.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LT(ellipseArea(growth.end[k].minimum.P_d), ellipseArea(growth.start[k].minimum.P_d));
    EXPECT_GT(ellipseArea(growth.end[k].maximum.P_d),
              1.5 * ellipseArea(growth.start[k].maximum.P_d));
    EXPECT_GT(ellipseArea(growth.end[k].mean), ellipseArea(growth.start[k].mean));
    EXPECT_LT(ellipseArea(growth.end[k].maximum.P_d), 0.1);  // m²: still in the picture
  }
}

TEST(FaultPaper, SpoilsTheFeaturesItIsTold) {
  for (const std::vector<FeatureId>& features :
       {std::vector<FeatureId>{3}, std::vector<FeatureId>{1, 6, 7, 11, 15}}) {
    Simulation simulation({.fault = "paper", .fault_features = features});
    while (simulation.step()) {
    }
    const Snapshot end = simulation.filter().snapshot();
    for (std::size_t k = 0; k < end.ids.size(); ++k) {
      const int row = Snapshot::row(static_cast<int>(k));
      const double area = ellipseArea(end.covariance.block2(row, row));
      const bool told = std::find(features.begin(), features.end(), end.ids[k]) != features.end();
      EXPECT_EQ(area > 3e-3, told) << end.ids[k] << " area " << area;
    }
  }
}

}  // namespace
}  // namespace slamscope::slam
