// SPDX-License-Identifier: MIT
#include "tracking/symmetric_solve.hpp"

#include <Eigen/Cholesky>
#include <limits>

namespace slamscope::tracking {

UpTo12 solveSymmetric(const UpTo12& A, const UpTo12& B) {
  // Eigen's LDLT takes what is no number for zero.
  if (!A.allFinite()) {
    return UpTo12::Constant(B.rows(), B.cols(), std::numeric_limits<double>::quiet_NaN());
  }
  return A.ldlt().solve(B);
}

UpTo12 inverseOfSymmetric(const UpTo12& A) {
  return solveSymmetric(A, UpTo12::Identity(A.rows(), A.cols()));
}

}  // namespace slamscope::tracking
