// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "slam/audit/outcome.hpp"
#include "slam/audit/transition.hpp"

namespace slamscope::slam {

/// shrink: over an update D = P⁻ − P⁺ ⪰ 0, because D = K S Kᵀ: no variance, no P_d, no principal
/// block grows. Over a whole time step (L1, LC) it holds on the map, which predictions leave alone.
/// On the diagonal alone (L0): no variance grows.
///
/// Residual: growth scaled by √diag P⁻. Tolerance 1e-8 + 8 noise.
///
/// `everything`: all pairs of features, O(n²). Otherwise the features and the block of robot and
/// observed features: enough where `support` is whole, as then D has its inertia there.
[[nodiscard]] Outcome checkShrink(const Transition& transition, bool map_only, bool everything);

/// What a growth scaled by √diag P⁻ may come to by rounding.
[[nodiscard]] inline double shrinkTolerance(const Transition& transition) {
  return 1e-8 + 8.0 * transition.noise;
}

/// Whether no feature's covariance grows. `diagonal`, `beside`: D(i, i) and D(i, i − 1).
[[nodiscard]] bool featuresShrink(const Transition& transition, const Eigen::VectorXd& diagonal,
                                  const Eigen::VectorXd& beside);

}  // namespace slamscope::slam
