// SPDX-License-Identifier: MIT
#pragma once

#include "slam/audit/law_support.hpp"
#include "slam/audit/outcome.hpp"

namespace slamscope::slam {

/// range: Δx = K ν ∈ range(D), since D = K S Kᵀ: state and covariance were updated with one gain.
///
/// Residual: part of the scaled Δx outside the span of P⁻B_iᵀ (culprits of `support` left out), of
/// Δx. Tolerance: 1e-5 and what rounding of means and of P leaves.
/// That tolerance, for a scaled Δx with a largest entry of `size`, of which `span` (of the same
/// unit) may be left outside of the span.
[[nodiscard]] double rangeTolerance(const Transition& transition, double span, double size);

[[nodiscard]] Outcome checkRange(const Transition& transition, const UpdateAnatomy& anatomy);

}  // namespace slamscope::slam
