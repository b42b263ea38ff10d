// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "slam/recording.hpp"

namespace slamscope::slam::testing {

/// The least-squares solution of a whole recording of increments and relative positions with known
/// ids (an iSAM graph): what a filter that linearises once can at best come near to. By Ceres.
class BatchGraph {
 public:
  explicit BatchGraph(const Recording& recording);

  /// Values to start from: the pose of the recording's time, and all features, as a filter has
  /// them.
  void start(const Snapshot& snapshot);
  void solve();

  [[nodiscard]] Eigen::Vector2d feature(FeatureId id) const { return features_.at(id); }
  [[nodiscard]] double initialCost() const { return initial_cost_; }
  [[nodiscard]] double finalCost() const { return final_cost_; }

 private:
  const Recording& recording_;
  std::vector<Eigen::Vector3d> poses_;  ///< at the times of the odometry
  std::map<FeatureId, Eigen::Vector2d> features_;
  double initial_cost_ = 0.0;
  double final_cost_ = 0.0;
};

}  // namespace slamscope::slam::testing
