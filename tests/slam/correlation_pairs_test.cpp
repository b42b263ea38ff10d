// SPDX-License-Identifier: MIT
#include "slam/correlation_pairs.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "slam/correlation.hpp"
#include "slam/simulation_random.hpp"

namespace slamscope::slam {
namespace {

/// Five features in two clusters, {0, 2} and {1, 3, 4}, with a random covariance.
struct Fixture {
  Snapshot snapshot;
  Clustering clusters;

  Fixture() {
    snapshot.ids = {10, 20, 30, 40, 50};
    snapshot.features = {{0, 0}, {5, 0}, {0, 2}, {5, 3}, {5, 6}};
    RandomSource random(8);
    Eigen::MatrixXd A(13, 13);
    for (double& value : A.reshaped()) value = random.normal();
    snapshot.covariance = PackedCovariance::fromLower(A * A.transpose());
    clusters = clusterAt(snapshot.features, 4.0);
  }
};

std::vector<std::pair<int, int>> indices(const PairSelection& selection) {
  std::vector<std::pair<int, int>> result;
  for (const FeaturePair& pair : selection.pairs) result.emplace_back(pair.i, pair.j);
  return result;
}

TEST(Pairs, AllAreAll) {
  const Fixture f;
  const PairSelection all = selectPairs(f.snapshot, PairMode::all, f.clusters);
  EXPECT_EQ(all.pairs.size(), 10U);
  EXPECT_TRUE(all.cluster_pairs.empty());
  for (const FeaturePair& pair : all.pairs) {
    EXPECT_LT(pair.i, pair.j);
    EXPECT_EQ(pair.P_d, relativeCovariance(f.snapshot, pair.i, pair.j));
  }
}

TEST(Pairs, BetweenClustersLeavesThoseInsideOut) {
  const Fixture f;
  const PairSelection between = selectPairs(f.snapshot, PairMode::between_clusters, f.clusters);
  EXPECT_EQ(indices(between),
            (std::vector<std::pair<int, int>>{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {2, 3}, {2, 4}}));
}

TEST(Pairs, MinMeanMaxSummariseThePairsOfTwoClusters) {
  const Fixture f;
  const PairSelection selection = selectPairs(f.snapshot, PairMode::min_mean_max, f.clusters);
  EXPECT_TRUE(selection.pairs.empty());
  ASSERT_EQ(selection.cluster_pairs.size(), 1U);
  const ClusterPair& pair = selection.cluster_pairs[0];
  EXPECT_EQ(pair.centroid_a, Eigen::Vector2d(0, 1));
  EXPECT_EQ(pair.centroid_b, Eigen::Vector2d(5, 3));
  Eigen::Matrix2d mean = Eigen::Matrix2d::Zero();
  const auto between = selectPairs(f.snapshot, PairMode::between_clusters, f.clusters).pairs;
  int at_minimum = 0;
  int at_maximum = 0;
  for (const FeaturePair& each : between) {
    mean += each.P_d / 6.0;
    EXPECT_GE(ellipseArea(each.P_d), ellipseArea(pair.minimum.P_d));
    EXPECT_LE(ellipseArea(each.P_d), ellipseArea(pair.maximum.P_d));
    at_minimum += each.i == pair.minimum.i && each.j == pair.minimum.j ? 1 : 0;
    at_maximum += each.i == pair.maximum.i && each.j == pair.maximum.j ? 1 : 0;
  }
  EXPECT_EQ(at_minimum, 1);
  EXPECT_EQ(at_maximum, 1);
  EXPECT_LT((mean - pair.mean).norm(), 1e-13);
}

TEST(Pairs, SelectedTouchAPickedFeature) {
  const Fixture f;
  const std::vector<FeatureId> picked{30, 99};
  const PairSelection selection =
      selectPairs(f.snapshot, PairMode::selected, f.clusters, {.selected = picked});
  EXPECT_EQ(indices(selection), (std::vector<std::pair<int, int>>{{0, 2}, {1, 2}, {2, 3}, {2, 4}}));
  EXPECT_TRUE(selectPairs(f.snapshot, PairMode::selected, f.clusters).pairs.empty());
}

TEST(Pairs, AlarmsAreThoseHandedIn) {
  const Fixture f;
  const std::vector<std::pair<FeatureId, FeatureId>> alarms{{50, 10}, {20, 99}, {30, 30}};
  const PairSelection selection =
      selectPairs(f.snapshot, PairMode::alarms, f.clusters, {.alarms = alarms});
  EXPECT_EQ(indices(selection), (std::vector<std::pair<int, int>>{{0, 4}}));
}

TEST(Pairs, NoneWhereOnlyTheDiagonalIsKnown) {
  Fixture f;
  f.snapshot.diagonal_only = true;
  EXPECT_TRUE(selectPairs(f.snapshot, PairMode::all, f.clusters).pairs.empty());
}

TEST(Pairs, ClustersOfAnotherSnapshotAreRefused) {
  Fixture f;
  f.clusters.label.pop_back();
  EXPECT_THROW((void)selectPairs(f.snapshot, PairMode::between_clusters, f.clusters),
               std::invalid_argument);
  EXPECT_NO_THROW((void)selectPairs(f.snapshot, PairMode::all, f.clusters));
}

TEST(Pairs, ModesHaveNames) {
  for (const PairMode mode : {PairMode::all, PairMode::between_clusters, PairMode::min_mean_max,
                              PairMode::selected, PairMode::alarms}) {
    EXPECT_EQ(pairModeFromName(pairModeName(mode)), mode);
  }
  EXPECT_THROW((void)pairModeFromName("some"), std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::slam
