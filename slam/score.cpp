// SPDX-License-Identifier: MIT
#include "slam/score.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace slamscope::slam {
namespace {

using Points = std::span<const Eigen::Vector2d>;

Eigen::Vector2d meanOf(Points points) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

double rms(Points estimate, Points truth, const Alignment& alignment) {
  double sum = 0.0;
  for (std::size_t k = 0; k < estimate.size(); ++k) {
    sum += (alignment(estimate[k]) - truth[k]).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(estimate.size()));
}

}  // namespace

Eigen::Vector2d Alignment::operator()(const Eigen::Vector2d& point) const {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * point.x() - s * point.y() + translation.x(),
          s * point.x() + c * point.y() + translation.y()};
}

Alignment alignRigid(Points estimate, Points truth) {
  if (estimate.size() != truth.size() || estimate.empty()) {
    throw std::invalid_argument(
        "alignment needs as many estimates as true points, one at least; got " +
        std::to_string(estimate.size()) + " and " + std::to_string(truth.size()));
  }
  const Eigen::Vector2d mean_estimate = meanOf(estimate);
  const Eigen::Vector2d mean_truth = meanOf(truth);
  double along = 0.0;
  double across = 0.0;
  for (std::size_t k = 0; k < estimate.size(); ++k) {
    const Eigen::Vector2d a = estimate[k] - mean_estimate;
    const Eigen::Vector2d b = truth[k] - mean_truth;
    along += a.dot(b);
    across += a.x() * b.y() - a.y() * b.x();
  }
  Alignment alignment;
  alignment.angle = std::atan2(across, along);
  alignment.translation = mean_truth - alignment(mean_estimate);
  return alignment;
}

Scorer::Scorer(Subject& subject, EventSet events)
    : subscription_(subject.observe(events, [this](const SnapshotPtr& s) { take(s); })) {}

void Scorer::take(const SnapshotPtr& snapshot) {
  last_ = snapshot;
  if (!snapshot->truth || !snapshot->truth->pose.allFinite()) return;
  if (!times_.empty() && times_.back() == snapshot->time) {
    times_.pop_back();
    path_.pop_back();
    true_path_.pop_back();
  }
  times_.push_back(snapshot->time);
  path_.emplace_back(snapshot->pose.head<2>());
  true_path_.emplace_back(snapshot->truth->pose.head<2>());
}

Score Scorer::score() const {
  Score score;
  score.path_samples = path_.size();
  if (!path_.empty()) {
    score.path_rms = rms(path_, true_path_, {});
    score.path_rms_aligned = rms(path_, true_path_, alignRigid(path_, true_path_));
  }
  if (!last_) return score;
  score.features_found = last_->featureCount();
  if (!last_->truth || last_->truth->ids.empty()) return score;
  std::vector<Eigen::Vector2d> estimates;
  std::vector<Eigen::Vector2d> truths;
  for (std::size_t k = 0; k < last_->truth->ids.size(); ++k) {
    const auto index = last_->indexOf(last_->truth->ids[k]);
    if (!index) continue;
    estimates.push_back(last_->features[static_cast<std::size_t>(*index)]);
    truths.push_back(last_->truth->features[k]);
  }
  score.features_found = static_cast<int>(estimates.size());
  if (estimates.empty()) return score;
  score.features_rms = rms(estimates, truths, {});
  score.features_rms_aligned = rms(estimates, truths, alignRigid(estimates, truths));
  return score;
}

}  // namespace slamscope::slam
