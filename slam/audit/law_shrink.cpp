// SPDX-License-Identifier: MIT
#include "slam/audit/law_shrink.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "slam/audit/span_fit.hpp"

namespace slamscope::slam {
namespace {

/// Least eigenvalue of [a b; b c].
double leastEigenvalue(double a, double b, double c) {
  return 0.5 * (a + c) - std::hypot(0.5 * (a - c), b);
}

struct Growth {
  double of_feature = 0.0;  ///< worst, scaled
  int feature = -1;
  double of_pair = 0.0;
  int i = -1, j = -1;
  std::map<int, int> pairs_of;  ///< growing pairs by feature
  std::vector<std::pair<int, int>> pairs;
  std::vector<int> features;
};

void lookAtFeatures(const Transition& t, double tolerance, Growth& growth) {
  for (int i = 0; i < t.shared; ++i) {
    const int r = Snapshot::row(i);
    double least = leastEigenvalue(
        t.change(r, r), t.before->diagonal_only ? 0.0 : t.change(r, r + 1), t.change(r + 1, r + 1));
    for (int axis = 0; axis < 2; ++axis) {  // known exactly before, not any more
      if (t.scale[r + axis] == 0.0 && t.after->covariance(r + axis, r + axis) > 0.0) least = -1.0;
    }
    if (least >= -tolerance) continue;
    growth.features.push_back(i);
    if (-least > growth.of_feature) {
      growth.of_feature = -least;
      growth.feature = i;
    }
  }
}

void lookAtPairs(const Transition& t, double tolerance, Growth& growth) {
  const PackedCovariance& a = t.before->covariance;
  const PackedCovariance& b = t.after->covariance;
  const auto D = [&](int i, int j) { return a(i, j) - b(i, j); };
  for (int i = 1; i < t.shared; ++i) {
    const int r = Snapshot::row(i);
    const double d_xx = D(r, r), d_xy = D(r + 1, r), d_yy = D(r + 1, r + 1);
    for (int j = 0; j < i; ++j) {
      const int c = Snapshot::row(j);
      const double xx = d_xx + D(c, c) - 2.0 * D(r, c);
      const double yy = d_yy + D(c + 1, c + 1) - 2.0 * D(r + 1, c + 1);
      const double xy = d_xy + D(c + 1, c) - D(r, c + 1) - D(r + 1, c);
      const double least = leastEigenvalue(xx, xy, yy);
      const double unit =
          std::max(t.sigma[r], t.sigma[r + 1]) + std::max(t.sigma[c], t.sigma[c + 1]);
      if (least >= -tolerance * unit * unit) continue;
      ++growth.pairs_of[i];
      ++growth.pairs_of[j];
      growth.pairs.emplace_back(i, j);
      if (-least / (unit * unit) > growth.of_pair) {
        growth.of_pair = -least / (unit * unit);
        growth.i = i;
        growth.j = j;
      }
    }
  }
}

/// The few features that are in all the growing pairs: greedy cover.
std::vector<int> blamed(Growth growth) {
  std::vector<int> result = growth.features;
  while (true) {
    std::erase_if(growth.pairs, [&](const auto& pair) {
      return std::find(result.begin(), result.end(), pair.first) != result.end() ||
             std::find(result.begin(), result.end(), pair.second) != result.end();
    });
    if (growth.pairs.empty()) return result;
    std::map<int, int> count;
    for (const auto& [i, j] : growth.pairs) {
      ++count[i];
      ++count[j];
    }
    const auto most =
        std::max_element(count.begin(), count.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    result.push_back(most->first);
  }
}

void describe(const Transition& t, const Growth& growth, Outcome& outcome) {
  char text[200];
  if (growth.feature >= 0) {
    const int r = Snapshot::row(growth.feature);
    const int axis = t.change(r + 1, r + 1) < t.change(r, r) ? 1 : 0;
    const auto id = static_cast<unsigned long long>(t.id(growth.feature));
    std::snprintf(text, sizeof text, "the variance of feature %llu grows by %.2g %%", id,
                  100.0 * growth.of_feature);
    outcome.show("variance of feature " + std::to_string(id) + (axis == 0 ? " in x" : " in y"),
                 t.after->covariance(r + axis, r + axis), t.before->covariance(r + axis, r + axis),
                 LawfulIs::at_most);
  } else if (growth.i >= 0) {
    std::snprintf(text, sizeof text, "P_d of features %llu and %llu grows by %.2g %% of their own",
                  static_cast<unsigned long long>(t.id(growth.j)),
                  static_cast<unsigned long long>(t.id(growth.i)), 100.0 * growth.of_pair);
  } else {
    std::snprintf(text, sizeof text, "P grows by %.2g %% in a direction across several states",
                  100.0 * outcome.residual);
  }
  outcome.amount = text;
  if (t.observed_given && t.observed.size() == 1) {
    outcome.amount += " while feature " + std::to_string(t.id(t.observed[0])) + " is observed";
  }
}

}  // namespace

bool featuresShrink(const Transition& t, const Eigen::VectorXd& diagonal,
                    const Eigen::VectorXd& beside) {
  const double tolerance = shrinkTolerance(t);
  for (int i = 0; i < t.shared; ++i) {
    const int r = Snapshot::row(i);
    const Eigen::Vector2d scale = t.scale.segment<2>(r);
    const bool exact = scale.x() == 0.0 || scale.y() == 0.0;
    if (exact && (diagonal[r] < 0.0 || diagonal[r + 1] < 0.0)) return false;
    const double a = diagonal[r] * scale.x() * scale.x() + tolerance;
    const double b = beside[r + 1] * scale.x() * scale.y();
    const double c = diagonal[r + 1] * scale.y() * scale.y() + tolerance;
    if (!(a >= 0.0 && c >= 0.0 && a * c >= b * b)) return false;
  }
  return true;
}

Outcome checkShrink(const Transition& t, bool map_only, bool everything) {
  if (t.shared == 0 && map_only) return {};
  const double tolerance = shrinkTolerance(t);
  Growth growth;
  lookAtFeatures(t, tolerance, growth);
  double residual = growth.of_feature;
  if (!t.before->diagonal_only) {
    if (everything || !growth.features.empty()) lookAtPairs(t, tolerance, growth);
    std::vector<int> blocks = t.observed;
    if (!map_only) blocks.push_back(-1);
    const std::vector<int> states = statesOf(blocks);
    if (!states.empty()) {
      const Eigen::MatrixXd D = t.scaledBlock(states);
      const double size = static_cast<double>(states.size());
      Eigen::MatrixXd shifted = D;
      shifted.diagonal().array() += tolerance * size;
      if (Eigen::LLT<Eigen::MatrixXd>(shifted).info() != Eigen::Success) {
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(D, Eigen::EigenvaluesOnly);
        residual = std::max(residual, -eigen.eigenvalues()[0] / size);
      }
    }
    residual = std::max(residual, growth.of_pair);
  }
  Outcome outcome = Outcome::of(residual, tolerance);
  if (!outcome.violated()) return outcome;
  const std::vector<int> features = blamed(growth);
  if (2 * features.size() <= static_cast<std::size_t>(t.shared) || t.shared <= 2) {
    for (const int i : features) {
      outcome.blame.push_back({t.id(i), 1.0 / static_cast<double>(features.size())});
    }
  }
  describe(t, growth, outcome);
  return outcome;
}

}  // namespace slamscope::slam
