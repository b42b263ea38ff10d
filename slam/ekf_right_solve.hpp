// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace slamscope::slam {

/// Y ← B L⁻ᵀ for B (N×m) and the lower triangle of L (m×m): P Hᵀ to the Y of (11). Sixteen rows at
/// a time, in registers and first cache. Compiled for several instruction sets.
void solveFromTheRight(const Eigen::MatrixXd& L, const Eigen::MatrixXd& B, Eigen::MatrixXd& Y);

}  // namespace slamscope::slam
