// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

// The fits' linear systems, of any size up to twelve and without the heap, decomposed in one place:
// Eigen's decompositions cost some seconds of compile time for every fixed size and every file.
namespace slamscope::tracking {

using UpTo12 = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 12, 12>;

/// X of A X = B. A: symmetric, positive or negative semidefinite (LDLT), at most 12 × 12. Where A
/// is singular, a solution if there is one; not finite where A isn't.
[[nodiscard]] UpTo12 solveSymmetric(const UpTo12& A, const UpTo12& B);
/// A⁻¹ of the same.
[[nodiscard]] UpTo12 inverseOfSymmetric(const UpTo12& A);

}  // namespace slamscope::tracking
