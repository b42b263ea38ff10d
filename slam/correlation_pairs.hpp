// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "slam/clusters.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// Which pairs of features are shown (sections 3.2 and 4 of the paper; the last two are ours).
enum class PairMode { all, between_clusters, min_mean_max, selected, alarms };

/// `all`, `between-clusters`, `min-mean-max`, `selected`, `alarms`. The second throws
/// std::invalid_argument on others.
[[nodiscard]] std::string_view pairModeName(PairMode mode);
[[nodiscard]] PairMode pairModeFromName(std::string_view name);

/// A pair of features, indices in state order, i < j.
struct FeaturePair {
  int i = 0;
  int j = 0;
  Eigen::Matrix2d P_d = Eigen::Matrix2d::Zero();  ///< m²
};

/// All pairs between two clusters in three matrices. Minimum and maximum are by √det; the mean is
/// the matrix mean, whose √det can exceed the maximum's.
struct ClusterPair {
  int a = 0;  ///< clusters, a < b
  int b = 0;
  Eigen::Vector2d centroid_a = Eigen::Vector2d::Zero();  ///< m, mean of the features' estimates
  Eigen::Vector2d centroid_b = Eigen::Vector2d::Zero();
  FeaturePair minimum;
  Eigen::Matrix2d mean = Eigen::Matrix2d::Zero();
  FeaturePair maximum;
};

struct PairSelection {
  std::vector<FeaturePair> pairs;          ///< every mode but min_mean_max
  std::vector<ClusterPair> cluster_pairs;  ///< min_mean_max only
};

/// What a mode is told by others, by id; ids that are not in the map are passed over.
struct PairChoice {
  std::span<const FeatureId> selected{};                      ///< PairMode::selected
  std::span<const std::pair<FeatureId, FeatureId>> alarms{};  ///< PairMode::alarms
};

/// Of each cluster the mean of its features' estimates, m.
[[nodiscard]] std::vector<Eigen::Vector2d> centroids(const Snapshot& snapshot,
                                                     const Clustering& clusters);

/// The pairs that `mode` shows. `clusters` must be of this snapshot (used by the two modes that
/// speak of clusters), else std::invalid_argument. Empty where only the diagonal of P was logged.
[[nodiscard]] PairSelection selectPairs(const Snapshot& snapshot, PairMode mode,
                                        const Clustering& clusters, const PairChoice& choice = {});

}  // namespace slamscope::slam
