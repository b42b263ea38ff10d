// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "slam/audit/small_cholesky.hpp"
#include "slam/audit/transition.hpp"

namespace slamscope::slam {

/// B of an update: all B_i = [−I, −J(l_i − p), I] of the observed features, at the mean before it,
/// restricted to the robot's states and theirs: r = 2 |O| rows, 3 + r columns.
class RelativeCoordinates {
 public:
  void take(const Transition& transition);

  [[nodiscard]] Eigen::Index size() const { return lever_.size(); }
  /// l_i − p.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& deltas() const { return deltas_; }
  /// |B(m, 2)| of each row m: how the heading moves it.
  [[nodiscard]] double lever(Eigen::Index m) const { return std::abs(lever_[m]); }
  /// Σ_j |B(m, j)| σ_j for each row m, σ² the diagonal of P⁻.
  [[nodiscard]] const Eigen::ArrayXd& sigma() const { return sigma_; }

  /// B A Bᵀ for a symmetric A of 3 + r rows.
  void project(const Eigen::MatrixXd& A, SmallMatrix& projected);
  /// B z for each row z of `vectors` (4 × (3 + r)).
  void project(const FourColumns& vectors, FourColumns& projected) const;
  /// Bᵀ c for each row c of `vectors` (4 × r).
  void lift(const FourColumns& vectors, FourColumns& lifted) const;

 private:
  std::vector<Eigen::Vector2d> deltas_;
  Eigen::VectorXd lever_;  ///< B's column of the heading: δ_y, −δ_x of each feature
  Eigen::ArrayXd sigma_;
  Eigen::MatrixXd half_projected_;  ///< A Bᵀ
};

}  // namespace slamscope::slam
