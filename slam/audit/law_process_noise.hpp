// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "slam/audit/outcome.hpp"
#include "slam/audit/transition.hpp"

namespace slamscope::slam {

/// process-noise: Q̂ = P_vv⁺ − F P_vv⁻ Fᵀ ⪰ 0 with the lawful F of `motion`, and equal to Q where
/// one is declared: in the record (as added, frame of the map) or in the header (covariance of the
/// motion in the body frame over one record, turned by the heading before).
///
/// Residual: −least eigenvalue of Q̂ scaled by √diag P⁺, or the difference from Q scaled by that.
/// Tolerance 1e-7 + 12 noise. `motion_whole`: whether the law `motion` was ever seen whole; without
/// it a Q̂ that is slightly negative may be a UKF's.
[[nodiscard]] Outcome checkProcessNoise(const Transition& transition,
                                        const std::optional<Eigen::Matrix3d>& body_Q,
                                        bool motion_whole);

/// Q̂ of a prediction, m², m·rad, rad².
[[nodiscard]] Eigen::Matrix3d processNoiseOf(const Transition& transition);

/// Whether Q̂ keeps its direction in the map while the robot turns: a Q meant for the body frame
/// that was never rotated. Statistics: such a noise can be meant.
class UnrotatedNoise {
 public:
  void take(const Eigen::Matrix3d& Q, double heading);
  /// Clear anisotropy, headings spread by more than 60°, and directions of Q̂ that follow the map's
  /// axes, not the heading's.
  [[nodiscard]] bool found() const;

 private:
  int count_ = 0;
  // Doubled angles, as directions have no sign: sums of unit vectors.
  Eigen::Vector2d in_map_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d in_body_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d headings_ = Eigen::Vector2d::Zero();
};

}  // namespace slamscope::slam
