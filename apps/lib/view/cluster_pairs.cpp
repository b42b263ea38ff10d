// SPDX-License-Identifier: MIT
#include "apps/lib/view/cluster_pairs.hpp"

#include <utility>

#include "slam/correlation.hpp"

namespace slamscope::apps {
namespace {

slam::FeaturePair pairOf(const slam::Snapshot& snapshot,
                         const std::pair<std::uint32_t, std::uint32_t>& points) {
  const int i = static_cast<int>(points.first);
  const int j = static_cast<int>(points.second);
  return {.i = i, .j = j, .P_d = slam::relativeCovariance(snapshot, i, j)};
}

}  // namespace

ClusterPairs::ClusterPairs(std::shared_ptr<engine::Gpu> gpu) : extremes_(std::move(gpu)) {}

std::span<const slam::ClusterPair> ClusterPairs::of(const slam::SnapshotPtr& snapshot,
                                                    const engine::PlanarPointsPtr& points,
                                                    const slam::Clustering& clusters) {
  if (snapshot == snapshot_) return pairs_;
  snapshot_ = snapshot;
  pairs_.clear();
  problem_ = points ? extremes_.problemWith(*points) : std::string();
  const std::size_t count = clusters.members.size();
  if (count == 1) problem_ = "one cluster has no pairs of clusters; --cluster-cut makes more";
  if (count * (count - 1) / 2 > kMost) {
    problem_ = std::to_string(count) + " clusters are too many to show their pairs; a larger " +
               "--cluster-cut makes fewer";
  }
  if (!points || count == 0 || !problem_.empty()) return pairs_;
  const std::vector<std::uint32_t> groups(clusters.label.begin(), clusters.label.end());
  const std::vector<Eigen::Vector2d> centroids = slam::centroids(*snapshot, clusters);
  for (const engine::GroupPair& found : extremes_.find(points, groups)) {
    pairs_.push_back({.a = static_cast<int>(found.a),
                      .b = static_cast<int>(found.b),
                      .centroid_a = centroids[found.a],
                      .centroid_b = centroids[found.b],
                      .minimum = pairOf(*snapshot, found.least),
                      .mean = found.mean,
                      .maximum = pairOf(*snapshot, found.greatest)});
  }
  return pairs_;
}

}  // namespace slamscope::apps
