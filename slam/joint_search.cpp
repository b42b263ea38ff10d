// SPDX-License-Identifier: MIT
#include "slam/joint_search.hpp"

#include <algorithm>
#include <cmath>

namespace slamscope::slam {
namespace {

/// Readings with few candidates first: a wrong start is then found out early.
void orderGroups(std::vector<std::vector<Pairing>>& groups) {
  for (auto& group : groups) {
    std::sort(group.begin(), group.end(),
              [](const Pairing& a, const Pairing& b) { return a.gain > b.gain; });
  }
  std::stable_sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() < b.size() : a.front().gain > b.front().gain;
  });
}

}  // namespace

JointSearch::JointSearch(Covariance covariance, const Limits& limits)
    : covariance_(std::move(covariance)), limits_(limits) {}

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
  hope_.assign(groups_.size() + 1, 0.0);
  for (std::size_t k = groups_.size(); k-- > 0;) {
    double most = 0.0;
    for (const Pairing& pairing : groups_[k]) most = std::max(most, pairing.most);
    hope_[k] = hope_[k + 1] + most;
  }
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
    sums_.pop_back();
  }
  // The bound: without this reading, can the set still become as good?
  if (sums().gain + hope_[group + 1] > best_.gain - limits_.margin) branch(group + 1);
}

/// Keeps the set if it is the best so far, or rivals it.
void JointSearch::keep() {
  const double gain = sums().gain;
  if (gain < best_.gain - limits_.margin) return;
  if (limits_.margin > 0.0) rivals_.push_back({current_, gain});
  if (!(gain > best_.gain)) return;
  best_.pairings = current_;
  best_.gain = gain;
}

void JointSearch::strikeDisputed() {
  std::vector<Pairing> agreed;
  for (const Pairing& pairing : best_.pairings) {
    const bool disputed = std::any_of(rivals_.begin(), rivals_.end(), [&](const Result& rival) {
      return rival.gain >= best_.gain - limits_.margin &&
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
    Eigen::Matrix2d W = covariance_(pairing, current_[k]);
    W.noalias() -= L_.block(row, 0, 2, col) * L_.block(col, 0, 2, col).transpose();
    // W ← W L_kk⁻ᵀ by forward substitution over two columns
    W.col(0) /= L_(col, col);
    W.col(1) = (W.col(1) - L_(col + 1, col) * W.col(0)) / L_(col + 1, col + 1);
    L_.block<2, 2>(row, col) = W;
  }
  const auto before = L_.block(row, 0, 2, row);
  const Eigen::Matrix2d D = covariance_(pairing, pairing) - before * before.transpose();
  const double l00 = std::sqrt(D(0, 0));
  const double l10 = D(1, 0) / l00;
  const double l11 = std::sqrt(D(1, 1) - l10 * l10);
  if (!(l00 > 0.0) || !(l11 > 0.0)) return false;  // also where they are not numbers
  const Eigen::Vector2d rest = pairing.innovation - before * whitened_.head(row);
  const double w0 = rest[0] / l00;
  const double w1 = (rest[1] - l10 * w0) / l11;
  const double distance = w0 * w0 + w1 * w1;
  const double squared = sums().squared + distance;
  if (!(squared <= limits_.quantiles[current_.size()])) return false;
  L_.block<2, 2>(row, row) << l00, 0.0, l10, l11;
  whitened_.segment<2>(row) << w0, w1;
  current_.push_back(pairing);
  sums_.push_back({squared, sums().gain + pairing.bonus - 0.5 * distance - std::log(l00 * l11)});
  return true;
}

}  // namespace slamscope::slam
