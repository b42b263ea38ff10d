// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "slam/audit/law_support.hpp"
#include "slam/audit/transition.hpp"

namespace slamscope::slam {

/// What an update says of one observed feature.
struct FeatureInnovation {
  FeatureId id = 0;
  double nis = 0.0;  ///< χ² with `dof` degrees of freedom
  int dof = 0;
  /// Noise of the observation brought to the map, A⁻¹ R A⁻ᵀ (m²); absent (NaN) where unknown.
  Eigen::Matrix2d R_map = Eigen::Matrix2d::Constant(std::numeric_limits<double>::quiet_NaN());
  double R_error = 1.0;  ///< relative error of R_map that noise may cause
};

struct InnovationEstimate {
  double nis = 0.0;  ///< Δxᵀ D⁺ Δx over the directions that stand out of the noise
  int dof = 0;
  std::vector<FeatureInnovation> features;
  /// Where a heading comes besides: correlation of its noise with that of an observation, the
  /// largest. A compass errs on its own: 0. An observation used again, with H at the mean that its
  /// first use left, gives B_iᵀ + e_θ wᵀ anew: noise −w / (wᵀ R⁻¹ w), correlation 0.7.
  double heading_correlation = 0.0;
};

/// Innovation and its covariance without instrumenting the filter. Over an update Δx = T w with
/// D = T Tᵀ and w = S^(−1/2) ν ~ N(0, I), so Δxᵀ D⁺ Δx = ‖w‖² = νᵀ S⁻¹ ν, χ² with rank D. The rows
/// of robot and observed features suffice: D has its full rank there. With U = P⁻B_iᵀ, in units of
/// B_i: ν̃ = Uᵀ D⁺ Δx, S̃ = Uᵀ D⁺ U, and A⁻¹ R A⁻ᵀ = S̃ − B P⁻ Bᵀ.
[[nodiscard]] InnovationEstimate estimateInnovation(const Transition& transition,
                                                    const UpdateAnatomy& anatomy);

/// What an eigenvalue of D, of `rows` scaled states and with a largest one of `largest`, must
/// exceed to be more than rounding.
[[nodiscard]] double leastResolved(const Transition& transition, Eigen::Index rows, double largest);

/// Relative error of A⁻¹ R A⁻ᵀ = S̃ − B P⁻ Bᵀ, where D has a least eigenvalue of `least`.
[[nodiscard]] double noiseError(const Transition& transition, double least,
                                const Eigen::Matrix2d& S, const Eigen::Matrix2d& R_map);

/// Over a whole time step (L1) on the map: Δx_m is a sum of independent T w, so Δx_mᵀ D_m⁺ Δx_m is
/// χ² with rank D_m; likewise of any rows: those of the observed features, or where `observed` is
/// not in the log, of the features that P says were corrected most.
[[nodiscard]] InnovationEstimate estimateStepInnovation(const Transition& transition);

}  // namespace slamscope::slam
