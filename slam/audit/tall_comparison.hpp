// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "slam/audit/small_cholesky.hpp"

namespace slamscope::slam {

inline constexpr int kComparedImages = 2;

/// How much of two vectors y a combination of a few columns leaves over. `columns`: rows × count, a
/// multiple of eight rows; `weights`: what to take of each for each y (the first two of four);
/// `tall`: the two y and a scale for each row.
///
/// Largest (first row) |scale y| and (second row) |scale (y − columns weights)|, a column for each
/// y. All numbers must be finite.
void compareTall(const Eigen::MatrixXd& columns, const FourColumns& weights,
                 const Eigen::MatrixXd& tall, Eigen::Array2Xd& largest);

}  // namespace slamscope::slam
