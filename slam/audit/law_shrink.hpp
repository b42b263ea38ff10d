// SPDX-License-Identifier: MIT
#pragma once

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

}  // namespace slamscope::slam
