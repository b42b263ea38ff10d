// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace slamscope::slam::testing {

inline constexpr double kStep = 1e-5;
inline constexpr double kTolerance = 1e-7;

/// Derivative of `f` at `x` by central differences; `minus(a, b)` = a − b (where angles wrap).
template <typename Function, typename Minus>
Eigen::MatrixXd centralDifferences(Function f, const Eigen::VectorXd& x, Minus minus) {
  const Eigen::VectorXd f0 = f(x);
  Eigen::MatrixXd J(f0.size(), x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    Eigen::VectorXd up = x;
    Eigen::VectorXd down = x;
    up[k] += kStep;
    down[k] -= kStep;
    J.col(k) = minus(f(up), f(down)) / (2.0 * kStep);
  }
  return J;
}

/// Largest difference of two Jacobians relative to the larger of 1 and their largest entry.
inline double relativeDifference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() /
         std::max({1.0, a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()});
}

}  // namespace slamscope::slam::testing
