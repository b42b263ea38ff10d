// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "slam/audit/innovation_estimate.hpp"
#include "slam/audit/relative_coordinates.hpp"
#include "slam/audit/small_cholesky.hpp"
#include "slam/audit/transition.hpp"
#include "slam/audit/update_sweep.hpp"

namespace slamscope::slam {

/// Recognises an update that keeps support, rank, range, shrink and positive, and measures its
/// innovation: for most records that is all there is to do. It only ever confirms. What it does not
/// recognise – broken, rounded, linearised elsewhere, drowned in noise – is left to the laws' own
/// files, to judge and to explain.
///
/// Everything happens where the update was made, in the r = 2 |O| places of the observed features
/// relative to the robot. With U = P⁻Bᵀ a lawful update is D = U S̃⁻¹ Uᵀ and Δx = U S̃⁻¹ ν̃. So with
/// T = B P⁻ Bᵀ, r×r and regular,
///   D ω = U c, c = T⁻¹ B D ω      support, rank: any c that fits a random ω shows that D lies in
///                                 the span of U, but for a chance that nobody lives to see
///   Δx = U c', c' = T⁻¹ B Δx      range
///   M = B D Bᵀ = T S̃⁻¹ T ≻ 0      shrink
///   B P⁺ Bᵀ = T − M ⪰ 0           positive, where P⁻ was
///   ν̃ = T M⁻¹ B Δx, S̃ = T M⁻¹ T  nis, sensor-noise (innovation_estimate.hpp)
/// Cost: the pass over P⁻ and P⁺, O(N r) and O(r³), without an orthogonal basis of N×r.
class LawfulUpdate {
 public:
  /// Looks at an update that `sweep` has gone over.
  void take(const Transition& transition, const UpdateSweep& sweep);
  /// The record is no update.
  void skip() { recognised_ = false; }
  [[nodiscard]] bool recognised() const { return recognised_; }

  struct Fit {
    double residual = 0.0;   ///< largest entry outside of the span, of the largest entry
    double tolerance = 0.0;  ///< what rounding may leave there
  };
  // Of a recognised update:
  [[nodiscard]] const Fit& support() const { return support_; }
  [[nodiscard]] const Fit& range() const { return range_; }
  [[nodiscard]] const std::vector<Eigen::Vector2d>& deltas() const { return B_.deltas(); }
  [[nodiscard]] const InnovationEstimate& innovation() const { return innovation_; }

 private:
  bool fits(const Transition& t, const UpdateSweep& sweep);
  bool confirmsSupport(const Transition& t);
  bool confirmsRange(const Transition& t);
  bool shrinksAndStaysPositive(const Transition& t, const UpdateSweep& sweep);
  bool shrinksWithin(double tolerance);
  void measure(const Transition& t);
  bool measureAll(const Transition& t, double least_resolved);
  void measureFeature(const Transition& t, Eigen::Index k, double least);

  bool recognised_ = false;
  bool regular_ = false;  ///< M, in double precision
  Fit support_;
  Fit range_;
  InnovationEstimate innovation_;

  RelativeCoordinates B_;
  SmallMatrix T_, M_;
  SmallMatrix rest_;          ///< T − M
  SmallMatrix factor_;        ///< of T, then of M
  Eigen::MatrixXd tall_;      ///< columns D ω, Δx, 1 / √diag P⁻
  Eigen::Array2Xd largest_;   ///< entry of D ω and Δx, scaled: all of it, outside of the span
  FourColumns picked_;        ///< D ω and Δx at the states of robot and observed features
  FourColumns relative_;      ///< B times these
  FourColumns coefficients_;  ///< c and c'
  FourColumns weights_;       ///< Bᵀ c and Bᵀ c'
  ManyColumns solved_;        ///< L⁻¹ [T, B Δx, I], M = L Lᵀ
  Eigen::VectorXd relative_change_;
  Eigen::VectorXd squares_;      ///< of the columns of solved_
  Eigen::VectorXd innovations_;  ///< ν̃
};

}  // namespace slamscope::slam
