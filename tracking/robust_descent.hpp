// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "tracking/symmetric_solve.hpp"

// Least squares that outliers don't lead astray, over whatever state: what the fits of a scene and
// of a head have in common.
namespace slamscope::tracking {

/// Sum of weighted squares about a state, linearised: step = H⁻¹ g.
template <int N>
struct NormalEquations {
  Eigen::Matrix<double, N, N> H = Eigen::Matrix<double, N, N>::Zero();
  Eigen::Matrix<double, N, 1> g = Eigen::Matrix<double, N, 1>::Zero();
  double cost = 0;
  bool valid = true;  ///< false: the state puts something where it can't be seen
};

/// A squared error (sigmas) as it counts: fully within 4 sigmas of `scale`, as its logarithm
/// beyond.
struct RobustTerm {
  double weight, cost;
};
[[nodiscard]] RobustTerm robustTerm(double e2, double scale);
inline constexpr double kNoOutliers = 1e9;  ///< scale at which every error counts fully

/// How much larger errors (distances over sigmas) are than a 2D unit Gaussian's, by a quantile that
/// lets nearly two thirds of them be wrong; at least 1.
[[nodiscard]] double errorScale(std::vector<double> errors);

/// Levenberg's method until a step betters the cost by less than `tolerance` of it. Nothing where
/// it can't start.
template <typename State, typename Linearise, typename Move>
[[nodiscard]] std::optional<State> descend(State state, const Linearise& linearise,
                                           const Move& move, double tolerance) {
  constexpr int kMostSteps = 40;
  double damping = 1e-6;
  auto at = linearise(state);
  if (!at.valid) return std::nullopt;
  for (int i = 0; i < kMostSteps; ++i) {
    auto H = at.H;
    H.diagonal() *= 1 + damping;
    const decltype(at.g) step = solveSymmetric(H, at.g);
    if (!step.allFinite()) return std::nullopt;
    const State candidate = move(state, step);
    const auto next = linearise(candidate);
    if (next.valid && next.cost <= at.cost) {
      const bool at_rest = at.cost - next.cost < tolerance * (1 + at.cost);
      state = candidate;
      at = next;
      damping = std::max(1e-9, damping * 0.1);
      if (at_rest) break;
    } else if ((damping *= 10) > 1e6) {
      break;
    }
  }
  return state;
}

/// Descends with an ever narrower scale, so that outliers which share in a first compromise lose
/// their hold on it. `scale_of(state)`: of the errors; `descend_at(state, scale)`: roughly.
template <typename State, typename ScaleOf, typename DescendAt>
[[nodiscard]] std::optional<State> narrowDown(State state, const ScaleOf& scale_of,
                                              const DescendAt& descend_at) {
  constexpr int kMostRounds = 4;
  double scale = scale_of(state);
  for (int round = 0; round < kMostRounds; ++round) {
    const std::optional<State> better = descend_at(state, scale);
    if (!better) return std::nullopt;
    state = *better;
    const double narrower = std::max(1.0, std::min(scale / 3, scale_of(state)));
    if (narrower == scale) break;
    scale = narrower;
  }
  return state;
}

}  // namespace slamscope::tracking
