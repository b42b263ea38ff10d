// SPDX-License-Identifier: MIT
#include "slam/score.hpp"

#include <cmath>
#include <set>
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

void scoreFeatures(Score& score, Points estimates, Points truths) {
  if (estimates.empty()) return;
  score.features_rms = rms(estimates, truths, {});
  score.features_rms_aligned = rms(estimates, truths, alignRigid(estimates, truths));
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

Score Scorer::pathScore() const {
  Score score;
  score.path_samples = path_.size();
  if (path_.empty()) return score;
  if (own_frame_ == nullptr) score.path_rms = rms(path_, true_path_, {});
  score.path_rms_aligned = rms(path_, true_path_, alignRigid(path_, true_path_));
  return score;
}

Scorer::Scorer(Subject& subject, EventSet events)
    : subscription_(subject.observe(events, [this](const SnapshotPtr& s) { take(s); })) {}

Scorer::Scorer(Subject& subject, const Recording& recording) : Scorer(subject) {
  if (!recording.truth_in_map && !recording.truth_path.empty()) own_frame_ = &recording;
}

std::optional<Eigen::Vector2d> Scorer::truePosition(const Snapshot& snapshot) const {
  std::optional<Eigen::Vector3d> pose;
  if (own_frame_ != nullptr) {
    pose = own_frame_->truthAt(snapshot.time);
  } else if (snapshot.truth) {
    pose = snapshot.truth->pose;
  }
  if (!pose || !pose->head<2>().allFinite()) return std::nullopt;
  return pose->head<2>();
}

void Scorer::take(const SnapshotPtr& snapshot) {
  last_ = snapshot;
  const std::optional<Eigen::Vector2d> position = truePosition(*snapshot);
  if (!position) return;
  if (!times_.empty() && times_.back() == snapshot->time) {
    times_.pop_back();
    path_.pop_back();
    true_path_.pop_back();
  }
  times_.push_back(snapshot->time);
  path_.emplace_back(snapshot->pose.head<2>());
  true_path_.push_back(*position);
}

Score Scorer::score() const {
  Score score = pathScore();
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
  scoreFeatures(score, estimates, truths);
  return score;
}

Score Scorer::score(const Recording& recording, const std::map<FeatureId, FeatureId>& names) const {
  Score score = pathScore();
  if (!last_) return score;
  const std::map<FeatureId, Eigen::Vector2d> known(recording.truth_features.begin(),
                                                   recording.truth_features.end());
  std::vector<Eigen::Vector2d> estimates;
  std::vector<Eigen::Vector2d> truths;
  std::set<FeatureId> found;
  for (const auto& [feature, name] : names) {
    const auto index = last_->indexOf(feature);
    const auto truth = known.find(name);
    if (!index || truth == known.end()) continue;
    estimates.push_back(last_->features[static_cast<std::size_t>(*index)]);
    truths.push_back(truth->second);
    found.insert(name);
  }
  score.features_found = static_cast<int>(found.size());
  score.duplicates = static_cast<int>(estimates.size()) - score.features_found;
  scoreFeatures(score, estimates, truths);
  return score;
}

}  // namespace slamscope::slam
