// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <unordered_map>
#include <vector>

#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// Means of a record.
struct Means {
  Eigen::Vector3d pose = Eigen::Vector3d::Zero();
  std::vector<FeatureId> ids;
  std::vector<Eigen::Vector2d> features;

  [[nodiscard]] std::optional<Eigen::Vector2d> feature(FeatureId id) const;
};

/// Points at which a filter may have linearised, other than the mean before the update: what tells
/// lawful variants (frozen linearisation, first-estimates Jacobians) from a stale state.
struct LinearisationPoints {
  std::optional<Means> after_prediction;              ///< of the last prediction
  std::optional<Means> before_prediction;             ///< the record before it
  std::optional<Eigen::Vector3d> earlier_prediction;  ///< pose after the prediction before that
  std::unordered_map<FeatureId, Eigen::Vector2d> first_estimates;

  /// To be told of every record, `previous` may be null.
  void take(const SnapshotPtr& previous, const Snapshot& snapshot);
};

}  // namespace slamscope::slam
