// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "slam/recording.hpp"
#include "slam/subject.hpp"

namespace slamscope::slam {

/// Rigid motion of the plane, no scale: p_truth = R(angle) p_estimate + translation.
struct Alignment {
  double angle = 0.0;  ///< rad
  Eigen::Vector2d translation = Eigen::Vector2d::Zero();

  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector2d& point) const;
};

/// The least-squares alignment in closed form. One point: translation only. Throws
/// std::invalid_argument where sizes differ or there are no points.
[[nodiscard]] Alignment alignRigid(std::span<const Eigen::Vector2d> estimate,
                                   std::span<const Eigen::Vector2d> truth);

/// How far a run is from its truth. RMS of distances in m; absent where the run has no such truth.
struct Score {
  int features_found = 0;  ///< features of the last snapshot that exist (all of them without truth)
  std::optional<double> features_rms_aligned;
  std::optional<double> path_rms_aligned;
  std::optional<double> features_rms;
  std::optional<double> path_rms;
  std::size_t path_samples = 0;
  int duplicates = 0;  ///< features beyond the first of one name
};

/// Observes a run and scores it. Features: the last snapshot's, aligned by the features. Path: one
/// position a time stamp (the last of it), aligned by the path. Each is aligned by its own points,
/// so that one number never hides the other's error. True poses that are not finite are passed
/// over.
class Scorer {
 public:
  /// Listens to `events` of `subject` until it is destroyed.
  explicit Scorer(Subject& subject, EventSet events = {Event::step});
  /// Scores the path against that of `recording`, whose frame may be its own (GPS), so with
  /// alignment only. `recording` must outlive this.
  Scorer(Subject& subject, const Recording& recording);
  Scorer(const Scorer&) = delete;
  Scorer& operator=(const Scorer&) = delete;

  [[nodiscard]] Score score() const;
  /// Where the map's features have numbers of their own: `names` gives the id in `recording` of
  /// those that are to be scored.
  [[nodiscard]] Score score(const Recording& recording,
                            const std::map<FeatureId, FeatureId>& names) const;

 private:
  void take(const SnapshotPtr& snapshot);
  [[nodiscard]] Score pathScore() const;
  [[nodiscard]] std::optional<Eigen::Vector2d> truePosition(const Snapshot& snapshot) const;

  const Recording* own_frame_ = nullptr;
  SnapshotPtr last_;
  std::vector<std::chrono::nanoseconds> times_;
  std::vector<Eigen::Vector2d> path_;
  std::vector<Eigen::Vector2d> true_path_;
  Subscription subscription_;
};

}  // namespace slamscope::slam
