// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/render/group_extremes.hpp"
#include "slam/clusters.hpp"
#include "slam/correlation_pairs.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::apps {

/// What mode min-mean-max shows, found by the device: as slam::selectPairs() has it but for the
/// single precision of what decides which pair is least or greatest, and of the mean.
class ClusterPairs {
 public:
  /// So many pairs of clusters are shown, and no more: they would hide one another.
  static constexpr std::size_t kMost = 1000;

  explicit ClusterPairs(std::shared_ptr<engine::Gpu> gpu);

  /// `points`, `clusters`: of this snapshot; found again only for another snapshot. None where the
  /// points are null, the device can't take them or there are too many.
  [[nodiscard]] std::span<const slam::ClusterPair> of(const slam::SnapshotPtr& snapshot,
                                                      const engine::PlanarPointsPtr& points,
                                                      const slam::Clustering& clusters);
  /// Why there are none though there are clusters, in a line for people; else empty.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  engine::GroupExtremes extremes_;
  slam::SnapshotPtr snapshot_;  ///< whose pairs they are
  std::vector<slam::ClusterPair> pairs_;
  std::string problem_;
};

}  // namespace slamscope::apps
