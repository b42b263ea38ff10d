// SPDX-License-Identifier: MIT
#include "tracking/symmetric_solve.hpp"

#include <Eigen/Cholesky>

namespace slamscope::tracking {

UpTo12 solveSymmetric(const UpTo12& A, const UpTo12& B) {
  return A.ldlt().solve(B);
}

UpTo12 inverseOfSymmetric(const UpTo12& A) {
  return solveSymmetric(A, UpTo12::Identity(A.rows(), A.cols()));
}

}  // namespace slamscope::tracking
