// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>
#include <cmath>

namespace slamscope::slam::testing {

/// Least eigenvalue of a symmetric matrix scaled to a unit diagonal (rows of zero variance are left
/// out: they must be zero altogether, else −1).
inline double scaledLeastEigenvalue(const Eigen::MatrixXd& P) {
  Eigen::MatrixXd scaled = P;
  for (Eigen::Index i = 0; i < P.rows(); ++i) {
    for (Eigen::Index j = 0; j < P.cols(); ++j) {
      const double scale = std::sqrt(P(i, i) * P(j, j));
      if (!(P(i, i) >= 0.0) || (scale == 0.0 && P(i, j) != 0.0)) return -1.0;
      scaled(i, j) = scale > 0.0 ? P(i, j) / scale : (i == j ? 1.0 : 0.0);
    }
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
      .eigenvalues()[0];
}

}  // namespace slamscope::slam::testing
