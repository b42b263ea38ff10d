// SPDX-License-Identifier: MIT
#include "apps/lib/view/cluster_pairs.hpp"

#include <gtest/gtest.h>

#include "apps/lib/view/scene_builder.hpp"
#include "slam/correlation.hpp"
#include "slam/simulation.hpp"

// What the device makes of clusters, against slam/correlation in double precision.
namespace slamscope::apps {
namespace {

slam::SnapshotPtr endOf(int features) {
  slam::SimulationOptions options{.loops = 1};
  if (features > 0) {
    options.world = slam::WorldKind::uniform;
    options.features = features;
  }
  slam::Simulation simulation(options);
  while (simulation.step()) {
  }
  return std::make_shared<slam::Snapshot>(simulation.filter().snapshot());
}

/// Greatest difference of areas and means from those of double precision, relative.
double misfit(const slam::ClusterPair& found, const slam::ClusterPair& exact) {
  const auto area = [](const slam::FeaturePair& pair) { return slam::ellipseArea(pair.P_d); };
  return std::max({std::abs(area(found.minimum) / area(exact.minimum) - 1.0),
                   std::abs(area(found.maximum) / area(exact.maximum) - 1.0),
                   (found.mean - exact.mean).norm() / exact.mean.norm(),
                   (found.centroid_a - exact.centroid_a).norm(),
                   (found.centroid_b - exact.centroid_b).norm()});
}

class ClusterPairsTest : public testing::Test {
 protected:
  std::vector<slam::ClusterPair> found(const slam::SnapshotPtr& snapshot,
                                       const slam::Clustering& clusters) {
    const auto pairs = pairs_.of(snapshot, pointsOf(*snapshot), clusters);
    return {pairs.begin(), pairs.end()};
  }
  ClusterPairs pairs_{std::make_shared<engine::Gpu>()};
};

TEST_F(ClusterPairsTest, AreThoseOfDoublePrecision) {
  for (const int features : {0, 120}) {
    const slam::SnapshotPtr snapshot = endOf(features);
    const slam::Clustering clusters =
        slam::clusterAt(snapshot->features, features > 0 ? 0.24 : 0.6);
    ASSERT_GT(clusters.count(), 1);
    ASSERT_LT(clusters.count(), 45) << "else they are too many";
    auto exact = slam::selectPairs(*snapshot, slam::PairMode::min_mean_max, clusters).cluster_pairs;
    const auto pairs = found(snapshot, clusters);
    ASSERT_EQ(pairs.size(), exact.size());
    for (const slam::ClusterPair& pair : pairs) {
      const auto same = std::ranges::find_if(
          exact, [&](const auto& other) { return other.a == pair.a && other.b == pair.b; });
      ASSERT_NE(same, exact.end());
      EXPECT_LT(misfit(pair, *same), 1e-3);
    }
    // Twin: a thousandth's more covariance is another mean.
    exact.front().mean *= 1.002;
    EXPECT_GT(misfit(pairs.front(), exact.front()), 1e-3);
  }
}

TEST_F(ClusterPairsTest, TooManyAndTooFewAreSaidSo) {
  const slam::SnapshotPtr snapshot = endOf(60);
  const slam::Clustering alone = slam::clusterAt(snapshot->features, 1e-6);
  EXPECT_TRUE(found(snapshot, alone).empty());
  EXPECT_NE(pairs_.problem().find("60 clusters"), std::string::npos) << pairs_.problem();
  const slam::SnapshotPtr other = endOf(0);
  EXPECT_TRUE(found(other, slam::clusterAt(other->features, 1e6)).empty());
  EXPECT_NE(pairs_.problem().find("one cluster"), std::string::npos) << pairs_.problem();
  // Twin: a few are no problem.
  const slam::SnapshotPtr third = endOf(0);
  EXPECT_EQ(found(third, slam::clusterAt(third->features, 0.6)).size(), 3U);
  EXPECT_EQ(pairs_.problem(), "");
}

}  // namespace
}  // namespace slamscope::apps
