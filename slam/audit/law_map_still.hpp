// SPDX-License-Identifier: MIT
#pragma once

#include "slam/audit/outcome.hpp"
#include "slam/audit/transition.hpp"

namespace slamscope::slam {

/// map-still: a prediction moves the robot only, F = [F_v 0; 0 I] and Q = [Q_v 0; 0 0], so feature
/// means and P_mm stay. Residual: largest change of an entry of P_mm scaled by √diag, or of a mean
/// by its σ. Tolerance 1e-6 (forms that re-compute P lose a few digits, others none) + 4 noise.
/// Patterns: all of P_mm by one factor (inflation), the map turned as a rigid body (robocentric),
/// the diagonal alone (noise on features).
[[nodiscard]] Outcome checkMapStill(const Transition& transition);

}  // namespace slamscope::slam
