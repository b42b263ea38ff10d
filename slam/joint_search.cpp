// SPDX-License-Identifier: MIT
#include "slam/joint_search.hpp"

#include <algorithm>
#include <cmath>

namespace slamscope::slam {
namespace {

/// Readings with few candidates first: a wrong start is then found out early.
void orderGroups(std::vector<std::vector<Pairing>>& groups) {
  for (auto& group : groups) {
    std::sort(group.begin(), group.end(), [](const Pairing& a, const Pairing& b) {
      return a.squared_distance < b.squared_distance;
    });
  }
  std::stable_sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() < b.size()
                                : a.front().squared_distance < b.front().squared_distance;
  });
}

}  // namespace

JointSearch::JointSearch(const EkfState& state, std::span<const ExpectedReading> expected,
                         std::span<const Observation> readings, const Limits& limits)
    : state_(state), expected_(expected), readings_(readings), limits_(limits) {}

JointSearch::Result JointSearch::run(std::vector<Pairing> compatible) {
  std::stable_sort(compatible.begin(), compatible.end(),
                   [](const Pairing& a, const Pairing& b) { return a.reading < b.reading; });
  for (const Pairing& pairing : compatible) {
    if (groups_.empty() || groups_.back().front().reading != pairing.reading)
      groups_.emplace_back();
    groups_.back().push_back(pairing);
  }
  orderGroups(groups_);
  if (groups_.size() > kMostReadings) {
    groups_.resize(kMostReadings);
    best_.cut_short = true;
  }
  const auto rows = static_cast<Eigen::Index>(2 * groups_.size());
  L_.setZero(rows, rows);
  whitened_.setZero(rows);
  branch(0);
  strikeDisputed();
  return best_;
}

void JointSearch::branch(std::size_t group) {
  keep();
  if (group == groups_.size()) return;
  for (const Pairing& pairing : groups_[group]) {
    if (limits_.tries <= 0) {
      best_.cut_short = true;
      return;
    }
    const bool taken = std::any_of(current_.begin(), current_.end(), [&](const Pairing& other) {
      return other.feature == pairing.feature;
    });
    if (taken || !push(pairing)) continue;
    branch(group + 1);
    current_.pop_back();
    squared_.pop_back();
  }
  // The bound: without this reading, can the set still become larger, or as large and nearer?
  const std::size_t reachable = current_.size() + groups_.size() - group - 1;
  const double squared = squared_.empty() ? 0.0 : squared_.back();
  const bool hopeful =
      reachable > best_.pairings.size() ||
      (reachable == best_.pairings.size() && squared < best_.squared_distance + limits_.margin);
  if (hopeful) branch(group + 1);
}

/// Keeps the set if it is the best so far, or rivals it.
void JointSearch::keep() {
  const double squared = squared_.empty() ? 0.0 : squared_.back();
  const std::size_t most = best_.pairings.size();
  if (current_.size() < most) return;
  if (current_.size() > most) rivals_.clear();
  const bool better = current_.size() > most || squared < best_.squared_distance;
  if (!better && squared > best_.squared_distance + limits_.margin) return;
  if (limits_.margin > 0.0) rivals_.push_back({current_, squared});
  if (!better) return;
  best_.pairings = current_;
  best_.squared_distance = squared;
}

void JointSearch::strikeDisputed() {
  std::vector<Pairing> agreed;
  for (const Pairing& pairing : best_.pairings) {
    const bool disputed = std::any_of(rivals_.begin(), rivals_.end(), [&](const Result& rival) {
      return rival.squared_distance <= best_.squared_distance + limits_.margin &&
             std::none_of(rival.pairings.begin(), rival.pairings.end(), [&](const Pairing& other) {
               return other.reading == pairing.reading && other.feature == pairing.feature;
             });
    });
    if (!disputed) agreed.push_back(pairing);
  }
  best_.pairings = std::move(agreed);
}

/// Whether the set stays jointly compatible with one more; if so it is in the set then.
bool JointSearch::push(const Pairing& pairing) {
  --limits_.tries;
  const auto row = static_cast<Eigen::Index>(2 * current_.size());
  for (std::size_t k = 0; k < current_.size(); ++k) {
    const auto col = static_cast<Eigen::Index>(2 * k);
    Eigen::Matrix2d W = crossCovariance(pairing.feature, current_[k].feature);
    W.noalias() -= L_.block(row, 0, 2, col) * L_.block(col, 0, 2, col).transpose();
    // W ← W L_kk⁻ᵀ by forward substitution over two columns
    W.col(0) /= L_(col, col);
    W.col(1) = (W.col(1) - L_(col + 1, col) * W.col(0)) / L_(col + 1, col + 1);
    L_.block<2, 2>(row, col) = W;
  }
  const auto reading = static_cast<std::size_t>(pairing.reading);
  const auto feature = static_cast<std::size_t>(pairing.feature);
  const auto before = L_.block(row, 0, 2, row);
  const Eigen::Matrix2d S = expected_[feature].HPHt + readings_[reading].R;
  const Eigen::Matrix2d D = S - before * before.transpose();
  const double l00 = std::sqrt(D(0, 0));
  const double l10 = D(1, 0) / l00;
  const double l11 = std::sqrt(D(1, 1) - l10 * l10);
  if (!(l00 > 0.0) || !(l11 > 0.0)) return false;  // also where they are not numbers
  const Eigen::Vector2d rest = pairing.innovation - before * whitened_.head(row);
  const double w0 = rest[0] / l00;
  const double w1 = (rest[1] - l10 * w0) / l11;
  const double squared = (squared_.empty() ? 0.0 : squared_.back()) + w0 * w0 + w1 * w1;
  if (!(squared <= limits_.quantiles[current_.size()])) return false;
  L_.block<2, 2>(row, row) << l00, 0.0, l10, l11;
  whitened_.segment<2>(row) << w0, w1;
  current_.push_back(pairing);
  squared_.push_back(squared);
  return true;
}

/// H_a P H_bᵀ of two features' readings, from the lower triangle of P.
Eigen::Matrix2d JointSearch::crossCovariance(int a, int b) const {
  const ExpectedReading& of_a = expected_[static_cast<std::size_t>(a)];
  const ExpectedReading& of_b = expected_[static_cast<std::size_t>(b)];
  const int row_a = Snapshot::row(a);
  const int row_b = Snapshot::row(b);
  const Eigen::Matrix3d P_vv = state_.P.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>();
  const Matrix23d P_av = state_.P.block<2, 3>(row_a, 0);
  const Matrix23d P_bv = state_.P.block<2, 3>(row_b, 0);
  const Eigen::Matrix2d P_ab =
      row_a > row_b ? Eigen::Matrix2d(state_.P.block<2, 2>(row_a, row_b))
                    : Eigen::Matrix2d(state_.P.block<2, 2>(row_b, row_a).transpose());
  return (of_a.H_v * P_vv + of_a.H_f * P_av) * of_b.H_v.transpose() +
         (of_a.H_v * P_bv.transpose() + of_a.H_f * P_ab) * of_b.H_f.transpose();
}

}  // namespace slamscope::slam
