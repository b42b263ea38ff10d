// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

#include "slam/audit/outcome.hpp"
#include "slam/audit/transition.hpp"

namespace slamscope::slam {

struct InitialiseCheck {
  Outcome outcome;
  std::optional<std::string_view> allow;  ///< word of --allow that the pattern fits
};

/// initialise: a new feature l = p + R(θ)(…) gets P_l,old = G P_v,old with
/// G = [1 0 −(l_y − p_y); 0 1 (l_x − p_x)], and P_ll − G P_vv Gᵀ ≻ 0 is the reading's noise.
/// Several in one record: P_l1,l2 = G₁ P_vv G₂ᵀ besides. What was in the map before stays. Where R
/// is declared (`sensor`, `R`): P_ll − G P_vv Gᵀ = A⁻¹ R A⁻ᵀ, A the derivative of the reading by l
/// − p.
///
/// Residual: largest difference scaled by √(P_ll P_jj). Tolerance 1e-6 + 8 × rounding.
/// An uncorrelated feature with a round, huge covariance is one that a first update will place
/// (diffuse initialisation): not checkable.
[[nodiscard]] InitialiseCheck checkInitialise(const Transition& transition, Sensor sensor,
                                              const std::optional<Eigen::Matrix2d>& R);

/// Whether feature `index` of `snapshot` stands to the robot and to the other features of the map
/// as one that was initialised just now.
[[nodiscard]] bool looksInitialised(const Snapshot& snapshot, int index, double noise);

}  // namespace slamscope::slam
