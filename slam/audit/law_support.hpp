// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "slam/audit/linearisation.hpp"
#include "slam/audit/outcome.hpp"
#include "slam/audit/span_fit.hpp"
#include "slam/audit/transition.hpp"

namespace slamscope::slam {

struct InnovationEstimate;

/// What an update turned out to be: shared by the laws on updates.
struct UpdateAnatomy {
  std::vector<int> observed;            ///< O, places among the shared features
  bool observed_found = false;          ///< found from range(D), not given
  std::vector<Eigen::Vector2d> deltas;  ///< l_i − p where the filter linearised, one for each of O
  ProbedChange change;
  SpanBasis basis;       ///< P⁻B_iᵀ at `deltas`
  OrthonormalSpan span;  ///< of `basis`
  SpanFit fit;
  std::vector<int> outside;  ///< culprits: places of features, −1 the robot
  Outcome support;
  std::optional<std::string_view> allow;  ///< word of --allow that the pattern fits
  /// D lies in the span of P⁻B_iᵀ and P⁻e_θ: a compass, or an observation that was used twice.
  bool heading_besides = false;
};

/// support (with gauge): range(D) ⊆ span{P⁻B_iᵀ : i ∈ O}, B_i = [−I, −J(l_i − p), I] at x⁻.
///
/// From D = P⁻Hᵀ S⁻¹ H P⁻ and H_i = A_i B_i with A_i regular: any relative observation is a
/// function of R(θ)ᵀ(l_i − p), whose derivative is R(θ)ᵀ B_i. Needs neither H nor an inverse of P.
/// D is seen through two random vectors; residual: the largest entry of their images outside the
/// span, of the largest entry. Tolerance: 8 × what rounding leaves (span_fit), plus 1e-6.
///
/// Broken: the smallest set of features is sought without whose rows and columns D is whole; these
/// were written outside the update. Otherwise the δ_i = l_i − p is solved for at which the filter
/// did linearise (linear: P⁻B_iᵀ is affine in δ_i), and the feature whose block H was written to.
/// Whole at the mean after the last prediction counts as whole (frozen linearisation).
[[nodiscard]] UpdateAnatomy checkSupport(const Transition& transition,
                                         const LinearisationPoints& points);

/// support again, once the innovations are known: a heading that comes with the noise of an
/// observation is no compass, but that observation used twice.
void tellUsedTwice(const InnovationEstimate& estimate, UpdateAnatomy& anatomy);

/// rank at level L1 (`observed` given): D_m = P_mm⁻ − P_mm⁺ over a whole time step lies in the span
/// of P⁻[−I, 0, I]ᵀ, i ∈ O, and P⁻e_θ: 2|O| + 1 vectors, wherever the filter linearised and however
/// many updates there were, as predictions change P_mv only by a multiple of P_mθ.
[[nodiscard]] UpdateAnatomy checkStepRank(const Transition& transition);

/// rank at L2: numerical rank of D ≤ 2|O|. Implied where `support` is whole.
[[nodiscard]] Outcome checkRank(const Transition& transition, const UpdateAnatomy& anatomy);

}  // namespace slamscope::slam
