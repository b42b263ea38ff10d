// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

#include "slam/audit/linearisation.hpp"
#include "slam/audit/outcome.hpp"
#include "slam/audit/transition.hpp"

namespace slamscope::slam {

/// F of a motion given in the robot's body frame, from the displacement of the mean (Δx, Δy):
/// x' = x + R(θ) u gives ∂x'/∂θ = J R(θ) u = J (x' − x), whatever u and its model.
[[nodiscard]] Eigen::Matrix3d lawfulMotionJacobian(const Eigen::Vector2d& displacement);

struct MotionCheck {
  Outcome outcome;
  std::optional<std::string_view> allow;  ///< word of --allow that the pattern fits
  bool nearly = false;                    ///< off by a small factor (UKF)
};

/// motion: over a prediction P_vm⁺ = F P_vm⁻. Residual: largest entry of the difference scaled by
/// √diag P⁺. Tolerance: 8 × rounding + 1e-7. Not checkable while P_vm is too small to tell.
/// With two features or more F is estimated by least squares and printed beside the lawful one.
/// Where F(1,3), F(2,3) are the lawful ones times 0.9 … 1.1 the filter averages over the heading
/// (UKF), which is not an EKF's Jacobian but no mistake: not checkable.
[[nodiscard]] MotionCheck checkMotion(const Transition& transition,
                                      const LinearisationPoints& points);

}  // namespace slamscope::slam
