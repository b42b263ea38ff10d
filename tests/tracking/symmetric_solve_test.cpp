// SPDX-License-Identifier: MIT
#include "tracking/symmetric_solve.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdlib>
#include <limits>

namespace slamscope::tracking {
namespace {

TEST(SymmetricSolve, SolvesAndInvertsEverySize) {
  std::srand(7);  // of Random
  for (int n = 1; n <= 12; ++n) {
    const Eigen::MatrixXd root = Eigen::MatrixXd::Random(n, n), B = Eigen::MatrixXd::Random(n, 3);
    const Eigen::MatrixXd A = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
    EXPECT_LT((A * solveSymmetric(A, B) - B).cwiseAbs().maxCoeff(), 1e-12) << n;
    EXPECT_LT((A * inverseOfSymmetric(A) - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(),
              1e-12)
        << n;
  }
}

TEST(SymmetricSolve, SolvesWhatIsSingularWhereASolutionIs) {
  Eigen::Matrix3d A = Eigen::Vector3d(1, 2, 3) * Eigen::RowVector3d(1, 2, 3);
  const Eigen::Vector3d b = A * Eigen::Vector3d(0.3, -0.7, 0.2);
  EXPECT_LT((A * solveSymmetric(A, b) - b).norm(), 1e-12);
  A(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(solveSymmetric(A, b).allFinite());
}

}  // namespace
}  // namespace slamscope::tracking
