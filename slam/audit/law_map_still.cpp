// SPDX-License-Identifier: MIT
#include "slam/audit/law_map_still.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "slam/score.hpp"

namespace slamscope::slam {
namespace {

struct Moved {
  double covariance = 0.0;
  int row = -1, col = -1;
  double mean = 0.0;
  int feature = -1;
  std::vector<int> features;  ///< with a changed diagonal block
};

double worstOfCovariance(const Transition& t, Moved& moved) {
  const double* const a = t.before->covariance.packed().data();
  const double* const b = t.after->covariance.packed().data();
  for (int i = 3; i < t.size(); ++i) {
    const auto r = static_cast<std::size_t>(i);
    const std::size_t start = r * (r + 1) / 2;
    // Nearly always the very same bits.
    if (std::memcmp(a + start + 3, b + start + 3, (r - 2) * sizeof(double)) == 0) continue;
    for (int j = 3; j <= i; ++j) {
      const double change = std::abs(t.change(i, j));
      if (change > moved.covariance) {
        moved.covariance = change;
        moved.row = i;
        moved.col = j;
      }
    }
  }
  return moved.covariance;
}

bool oneFactor(const Transition& t) {
  const double factor = t.after->covariance(3, 3) / t.before->covariance(3, 3);
  for (int i = 3; i < t.size(); ++i) {
    for (const int j : {i, 3}) {
      const double off = t.after->covariance(i, j) - factor * t.before->covariance(i, j);
      if (!(std::abs(off * t.scale[i] * t.scale[j]) < 1e-6)) return false;
    }
  }
  return true;
}

bool diagonalOnly(const Transition& t) {
  for (int i = 5; i < t.size(); ++i) {
    if (std::abs(t.change(i, 3 + (i % 2 == 0 ? 1 : 0))) > 1e-6) return false;
    if (t.change(i, i) > 1e-6) return false;  // grows, if anything
  }
  return true;
}

bool turnedRigidly(const Transition& t) {
  const auto count = static_cast<std::size_t>(t.shared);
  if (count < 3) return false;
  const std::span<const Eigen::Vector2d> a(t.before->features.data(), count);
  const std::span<const Eigen::Vector2d> b(t.after->features.data(), count);
  const Alignment alignment = alignRigid(a, b);
  double worst = 0.0;
  double size = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    worst = std::max(worst, (alignment(a[k]) - b[k]).norm());
    size = std::max(size, (b[k] - a[k]).norm());
  }
  return worst < 1e-6 * size;
}

}  // namespace

Outcome checkMapStill(const Transition& t) {
  if (t.shared == 0) return {};
  Moved moved;
  for (int i = 0; i < t.shared; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Eigen::Vector2d shift = t.after->features[k] - t.before->features[k];
    const Eigen::Vector2d sigma = t.sigma.segment<2>(Snapshot::row(i));
    for (int axis = 0; axis < 2; ++axis) {
      if (std::abs(shift[axis]) <= 4.0 * t.mean_noise) continue;
      const double amount = std::abs(shift[axis]) / std::max(sigma[axis], 1e-12);
      if (amount > moved.mean) {
        moved.mean = amount;
        moved.feature = i;
      }
    }
  }
  worstOfCovariance(t, moved);
  Outcome outcome = Outcome::of(std::max(moved.mean, moved.covariance), 1e-6 + 4.0 * t.noise);
  if (!outcome.violated()) return outcome;
  if (moved.covariance > outcome.tolerance && moved.row >= 0) {
    std::vector<int> grown;
    for (int i = 0; i < t.shared; ++i) {
      const int r = Snapshot::row(i);
      if (std::max(std::abs(t.change(r, r)), std::abs(t.change(r + 1, r + 1))) >
          outcome.tolerance) {
        grown.push_back(i);
      }
    }
    if (2 * grown.size() <= static_cast<std::size_t>(t.shared)) {
      for (const int i : grown) {
        outcome.blame.push_back({t.id(i), 1.0 / static_cast<double>(grown.size())});
      }
    }
    outcome.show("P(" + std::to_string(moved.row + 1) + "," + std::to_string(moved.col + 1) +
                     ") after a prediction",
                 t.after->covariance(moved.row, moved.col),
                 t.before->covariance(moved.row, moved.col));
    if (oneFactor(t)) outcome.patterns.emplace_back("inflation");
    if (outcome.patterns.empty() && diagonalOnly(t)) outcome.patterns.emplace_back("noise-on-map");
    outcome.amount = "a prediction changes the covariance of the map";
  } else {
    outcome.blame.push_back({t.id(moved.feature), 1.0});
    outcome.amount = "a prediction moves features";
  }
  if (turnedRigidly(t)) {
    outcome.patterns.emplace_back("robocentric");
    outcome.blame.clear();
  }
  return outcome;
}

}  // namespace slamscope::slam
