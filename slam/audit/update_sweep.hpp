// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "slam/audit/transition.hpp"

namespace slamscope::slam {

/// What the laws on an update need of P⁻ and P⁺, gathered in one pass over both: nearly all that a
/// large map costs is to fetch them. Its memory is kept from record to record.
class UpdateSweep {
 public:
  void take(const Transition& transition);

  /// Robot (0, 1, 2), then two for each observed feature; ascending.
  [[nodiscard]] const std::vector<int>& states() const { return states_; }
  /// D Σ⁻¹ ω for a random vector ω, Σ² the diagonal of P⁻. N rows and at times zeros below them, as
  /// in columns().
  [[nodiscard]] const Eigen::VectorXd& image() const { return image_; }
  /// Columns states() of P⁻.
  [[nodiscard]] const Eigen::MatrixXd& columns() const { return columns_; }
  /// Rows and columns states() of P⁻ and of D.
  [[nodiscard]] const Eigen::MatrixXd& blockBefore() const { return block_before_; }
  [[nodiscard]] const Eigen::MatrixXd& blockOfChange() const { return block_of_change_; }
  /// D(i, i) and D(i, i − 1).
  [[nodiscard]] const Eigen::VectorXd& diagonal() const { return diagonal_; }
  [[nodiscard]] const Eigen::VectorXd& besideDiagonal() const { return beside_diagonal_; }
  /// The least variance in P⁺.
  [[nodiscard]] double leastVariance() const { return least_variance_; }
  /// True: every entry of P⁺ is a finite number (if those of P⁻ are). False: perhaps not.
  [[nodiscard]] bool finite() const { return finite_; }

  /// Rows of the tall matrices here: N, rounded up.
  [[nodiscard]] static Eigen::Index padded(Eigen::Index rows) { return (rows + 7) / 8 * 8; }

 private:
  void resize(const Transition& transition);
  void gather(const double* before, const double* after, int row);

  std::vector<int> states_;
  std::size_t next_state_ = 0;  ///< of states_, while rows go by
  Eigen::MatrixXd omega_;
  Eigen::VectorXd scaled_omega_;
  Eigen::VectorXd image_;
  Eigen::MatrixXd columns_;
  Eigen::MatrixXd block_before_;
  Eigen::MatrixXd block_of_change_;
  Eigen::VectorXd diagonal_;
  Eigen::VectorXd beside_diagonal_;
  double least_variance_ = 0.0;
  bool finite_ = false;
};

}  // namespace slamscope::slam
