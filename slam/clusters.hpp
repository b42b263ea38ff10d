// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// An edge of the minimum spanning tree = a merge of the single-linkage dendrogram.
struct Edge {
  int i = 0;
  int j = 0;
  double length = 0.0;  ///< m
};

/// Minimum spanning tree of points under Euclidean distance (Prim, O(n²)), edges by rising length.
[[nodiscard]] std::vector<Edge> minimumSpanningTree(std::span<const Eigen::Vector2d> points);

/// Distance (m) at which the dendrogram is cut where the user gives none.
///
/// Real clusters leave a gap: the shortest edge between clusters is several times the longest edge
/// inside them. So the cut goes into the gap with the largest *ratio* of neighbouring edges, if
/// that ratio is at least kGapRatio and the clusters have three members or more on average; else
/// the map is one cluster. (The largest *difference*, the usual rule, always finds something to
/// cut and shatters uniform maps.) `held`: a cut from before, which stays while its own gap is at
/// least kHeldGapRatio wide.
[[nodiscard]] double defaultCut(std::span<const Edge> tree, std::optional<double> held = {});

inline constexpr double kGapRatio = 2.0;
inline constexpr double kHeldGapRatio = 1.5;

/// A partition of the features of one snapshot.
struct Clustering {
  double cut = 0.0;        ///< m, to show on screen
  bool automatic = true;   ///< the cut is ours, not the user's
  std::vector<int> label;  ///< cluster of each feature in state order, 0 … count − 1
  std::vector<std::vector<int>> members;  ///< features (indices in state order) of each cluster
  /// Two features that were there before came together or parted.
  bool repartitioned = false;
  /// Features were born or removed since the snapshot before.
  bool features_changed = false;

  [[nodiscard]] int count() const { return static_cast<int>(members.size()); }
};

/// Single-linkage clusters at a given cut, without memory. Clusters are numbered by their first
/// member.
[[nodiscard]] Clustering clusterAt(std::span<const Eigen::Vector2d> points, double cut);

/// Clusters over the course of a run, held with hysteresis so that estimates that move a little do
/// not make them flicker: features that are together part only when they are kHysteresis farther
/// than the cut, features that are apart join only when they are kHysteresis nearer.
class ClusterTracker {
 public:
  static constexpr double kHysteresis = 0.15;

  /// `cut` (m): the user's; automatic where absent. Throws std::invalid_argument unless positive.
  explicit ClusterTracker(std::optional<double> cut = {});

  /// The partition for this snapshot. `repartitioned` announces a change.
  const Clustering& update(const Snapshot& snapshot);
  [[nodiscard]] const Clustering& current() const { return current_; }

 private:
  [[nodiscard]] std::vector<int> previousLabels(const Snapshot& snapshot) const;

  std::optional<double> user_cut_;
  std::vector<FeatureId> ids_;
  Clustering current_;
};

}  // namespace slamscope::slam
