// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace slamscope::slam {

/// Y ← Y L⁻ᵀ for Y (N×m) and the lower triangle of L (m×m): P Hᵀ to the Y of (11). Sixteen rows at
/// a time, in registers and first cache. Compiled for several instruction sets.
void solveFromTheRight(const Eigen::MatrixXd& L, Eigen::MatrixXd& Y);

}  // namespace slamscope::slam
