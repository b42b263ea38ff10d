// SPDX-License-Identifier: MIT
#include "slam/clusters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "slam/simulation_random.hpp"
#include "slam/world.hpp"

namespace slamscope::slam {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points randomPoints(int count, RandomSource& random) {
  Points points;
  for (int k = 0; k < count; ++k) points.emplace_back(random.uniform(), random.uniform());
  return points;
}

/// Kruskal's tree, all pairs sorted: the oracle of Prim's.
double kruskalLength(const Points& points) {
  std::vector<Edge> edges;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    for (int j = i + 1; j < static_cast<int>(points.size()); ++j) {
      edges.push_back(
          {i, j,
           (points[static_cast<std::size_t>(i)] - points[static_cast<std::size_t>(j)]).norm()});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.length < b.length; });
  std::vector<int> label(points.size());
  std::iota(label.begin(), label.end(), 0);
  double sum = 0.0;
  for (const Edge& edge : edges) {
    const int a = label[static_cast<std::size_t>(edge.i)];
    const int b = label[static_cast<std::size_t>(edge.j)];
    if (a == b) continue;
    std::replace(label.begin(), label.end(), b, a);
    sum += edge.length;
  }
  return sum;
}

Snapshot snapshotOf(const Points& points) {
  Snapshot snapshot;
  snapshot.features = points;
  for (std::size_t k = 0; k < points.size(); ++k) snapshot.ids.push_back(k + 1);
  return snapshot;
}

/// Whether the clusters are the thirds in which a three-clusters world numbers its features.
bool areThirds(const Clustering& clusters, int count) {
  if (clusters.count() != 3) return false;
  for (int k = 0; k < count; ++k) {
    const int third = k < count / 3 ? 0 : k < count * 2 / 3 ? 1 : 2;
    if (clusters.label[static_cast<std::size_t>(k)] != third) return false;
  }
  return true;
}

TEST(Clusters, SpanningTreeIsMinimal) {
  RandomSource random(1);
  for (const int count : {2, 3, 10, 60}) {
    const Points points = randomPoints(count, random);
    const std::vector<Edge> tree = minimumSpanningTree(points);
    ASSERT_EQ(tree.size(), static_cast<std::size_t>(count - 1));
    double sum = 0.0;
    for (const Edge& edge : tree) sum += edge.length;
    EXPECT_NEAR(sum, kruskalLength(points), 1e-12);
    EXPECT_TRUE(std::is_sorted(tree.begin(), tree.end(),
                               [](const Edge& a, const Edge& b) { return a.length < b.length; }));
  }
  EXPECT_TRUE(minimumSpanningTree(Points{}).empty());
  EXPECT_TRUE(minimumSpanningTree(Points{{1, 1}}).empty());
}

TEST(Clusters, SingleLinkageFollowsAChain) {
  const Points points{{0, 0}, {5, 0}, {1, 0}, {2, 0}, {5.5, 0}, {3, 0}};
  const Clustering at_one = clusterAt(points, 1.0);
  EXPECT_EQ(at_one.label, (std::vector<int>{0, 1, 0, 0, 1, 0}));
  EXPECT_EQ(at_one.members[1], (std::vector<int>{1, 4}));
  EXPECT_EQ(clusterAt(points, 0.9).count(), 5);
  EXPECT_EQ(clusterAt(points, 2.0).count(), 1);
}

TEST(Clusters, DefaultCutFindsThePapersThreeClusters) {
  for (const int count : {9, 15, 30, 100}) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      const Points points = makeWorld(WorldKind::three_clusters, count, seed).features;
      const Clustering clusters = clusterAt(points, defaultCut(minimumSpanningTree(points)));
      EXPECT_TRUE(areThirds(clusters, count)) << count << " features, seed " << seed;
    }
  }
}

TEST(Clusters, DefaultCutLeavesUniformMapsWhole) {
  int few = 0;
  int few_by_largest_gap = 0;
  constexpr int kSeeds = 500;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Points points = makeWorld(WorldKind::uniform, 15, seed).features;
    const std::vector<Edge> tree = minimumSpanningTree(points);
    few += clusterAt(points, defaultCut(tree)).count() <= 2 ? 1 : 0;
    std::size_t widest = 1;
    for (std::size_t k = 1; k < tree.size(); ++k) {
      if (tree[k].length - tree[k - 1].length > tree[widest].length - tree[widest - 1].length) {
        widest = k;
      }
    }
    few_by_largest_gap += clusterAt(points, tree[widest - 1].length).count() <= 2 ? 1 : 0;
  }
  EXPECT_GE(few, kSeeds * 98 / 100);
  EXPECT_LT(few_by_largest_gap, kSeeds * 95 / 100) << "must fail: the usual rule shatters them";
}

TEST(Clusters, DefaultCutOfFewOrEqualPoints) {
  EXPECT_GT(defaultCut({}), 0.0);
  for (const Points& points : {Points{{0, 0}, {1, 0}}, Points{{0, 0}, {0, 0}, {0, 0}, {0, 0}},
                               Points{{0, 0}, {1, 0}, {9, 0}}}) {
    EXPECT_EQ(clusterAt(points, defaultCut(minimumSpanningTree(points))).count(), 1);
  }
}

TEST(ClusterTracker, HoldsMembershipsWithHysteresis) {
  ClusterTracker tracker(1.0);
  const auto at = [&](double gap) -> const Clustering& {
    return tracker.update(snapshotOf({{0, 0}, {gap, 0}}));
  };
  EXPECT_EQ(at(0.9).count(), 1);
  EXPECT_TRUE(tracker.current().features_changed);
  EXPECT_FALSE(tracker.current().repartitioned);
  EXPECT_EQ(at(1.1).count(), 1) << "a little over the cut: held together";
  EXPECT_EQ(at(1.2).count(), 2);
  EXPECT_TRUE(tracker.current().repartitioned);
  EXPECT_EQ(at(0.9).count(), 2) << "a little under the cut: held apart";
  EXPECT_FALSE(tracker.current().repartitioned);
  EXPECT_FALSE(tracker.current().features_changed);
  EXPECT_EQ(at(0.8).count(), 1);
  EXPECT_TRUE(tracker.current().repartitioned);
  EXPECT_FALSE(tracker.current().automatic);
  EXPECT_THROW(ClusterTracker(0.0), std::invalid_argument);
}

TEST(ClusterTracker, DoesNotFlickerWhileEstimatesMove) {
  RandomSource random(9);
  const Points truth = makeWorld(WorldKind::three_clusters, 15, 3).features;
  ClusterTracker tracker;
  int repartitions = 0;
  for (int k = 0; k < 500; ++k) {
    Points points = truth;
    for (Eigen::Vector2d& p : points) p += 0.03 * Eigen::Vector2d(random.normal(), random.normal());
    repartitions += tracker.update(snapshotOf(points)).repartitioned ? 1 : 0;
    EXPECT_TRUE(areThirds(tracker.current(), 15));
  }
  EXPECT_EQ(repartitions, 0);
  EXPECT_TRUE(tracker.current().automatic);
}

TEST(ClusterTracker, FollowsBirthAndRemoval) {
  ClusterTracker tracker(1.0);
  Snapshot snapshot = snapshotOf({{0, 0}, {0.5, 0}});
  tracker.update(snapshot);
  snapshot.ids.push_back(7);
  snapshot.features.emplace_back(3, 0);
  EXPECT_EQ(tracker.update(snapshot).count(), 2);
  EXPECT_TRUE(tracker.current().features_changed);
  EXPECT_FALSE(tracker.current().repartitioned);
  snapshot.ids.push_back(8);
  snapshot.features.emplace_back(1.3, 0);  // next to the first cluster, not to the second
  EXPECT_EQ(tracker.update(snapshot).label, (std::vector<int>{0, 0, 1, 0}));
  snapshot.ids.push_back(9);
  snapshot.features.emplace_back(2.2, 0);  // a bridge
  EXPECT_EQ(tracker.update(snapshot).count(), 1);
  EXPECT_TRUE(tracker.current().repartitioned);
  snapshot.ids.erase(snapshot.ids.begin());
  snapshot.features.erase(snapshot.features.begin());
  EXPECT_EQ(tracker.update(snapshot).count(), 1);
  EXPECT_FALSE(tracker.current().repartitioned);
  EXPECT_EQ(tracker.update(Snapshot{}).count(), 0);
}

}  // namespace
}  // namespace slamscope::slam
