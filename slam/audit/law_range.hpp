// SPDX-License-Identifier: MIT
#pragma once

#include "slam/audit/law_support.hpp"
#include "slam/audit/outcome.hpp"

namespace slamscope::slam {

/// range: Δx = K ν ∈ range(D), since D = K S Kᵀ: state and covariance were updated with one gain.
///
/// Residual: part of the scaled Δx outside the span of P⁻B_iᵀ (culprits of `support` left out), of
/// Δx. Tolerance: 1e-5 and what rounding of means and of P leaves.
[[nodiscard]] Outcome checkRange(const Transition& transition, const UpdateAnatomy& anatomy);

}  // namespace slamscope::slam
