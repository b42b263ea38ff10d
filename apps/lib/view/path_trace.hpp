// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace slamscope::apps {

/// The line through all past position estimates, thinned where they lie closer than can be seen.
/// Thinning doubles its step each time the line grows past kMostPoints, so that a run of hours
/// neither slows the picture down nor fills the memory.
class PathTrace {
 public:
  static constexpr std::size_t kMostPoints = 4000;

  void add(const Eigen::Vector2d& position) {
    newest_ = position;
    if (points_.empty() || (position - points_.back()).norm() >= step_) points_.push_back(position);
    if (points_.size() > kMostPoints) thin();
  }
  void clear() { *this = PathTrace{}; }

  /// Kept points in order, then the newest. Empty before the first.
  [[nodiscard]] std::vector<Eigen::Vector2d> points() const {
    std::vector<Eigen::Vector2d> all = points_;
    if (!all.empty() && all.back() != newest_) all.push_back(newest_);
    return all;
  }

 private:
  void thin() {
    step_ *= 2.0;
    std::vector<Eigen::Vector2d> kept;
    for (const Eigen::Vector2d& point : points_) {
      if (kept.empty() || (point - kept.back()).norm() >= step_) kept.push_back(point);
    }
    points_ = std::move(kept);
  }

  std::vector<Eigen::Vector2d> points_;
  Eigen::Vector2d newest_ = Eigen::Vector2d::Zero();
  double step_ = 0.002;  ///< m
};

}  // namespace slamscope::apps
