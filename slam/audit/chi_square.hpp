// SPDX-License-Identifier: MIT
#pragma once

namespace slamscope::slam {

/// P(χ²_dof ≤ value): the regularised incomplete gamma function P(dof/2, value/2), by its series or
/// continued fraction (Numerical Recipes 6.2). dof ≥ 1.
[[nodiscard]] double chiSquareProbability(double value, double dof);

/// The value that χ²_dof exceeds with probability `upper_tail` in (0, 1), by bisection.
[[nodiscard]] double chiSquareQuantile(double upper_tail, double dof);

}  // namespace slamscope::slam
