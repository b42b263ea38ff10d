// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "slam/audit/packed_change.hpp"
#include "slam/audit/transition.hpp"

namespace slamscope::slam {

class HelperThread;

/// What the laws on an update need of P⁻ and P⁺, gathered in one pass over both: nearly all that a
/// large map costs is to fetch them. Large ones are shared with a second thread, which starts with
/// the first of them. Its memory is kept from record to record.
class UpdateSweep {
 public:
  UpdateSweep();
  ~UpdateSweep();
  UpdateSweep(const UpdateSweep&) = delete;
  UpdateSweep& operator=(const UpdateSweep&) = delete;

  void take(const Transition& transition);

  /// Robot (0, 1, 2), then two for each observed feature; ascending.
  [[nodiscard]] const std::vector<int>& states() const { return states_; }
  /// D Σ⁻¹ ω for a random vector ω, Σ² the diagonal of P⁻. N rows and at times zeros below them, as
  /// in columns().
  [[nodiscard]] const Eigen::VectorXd& image() const { return parts_[0].image; }
  /// Columns states() of P⁻.
  [[nodiscard]] const Eigen::MatrixXd& columns() const { return columns_; }
  /// Rows and columns states() of P⁻ and of D.
  [[nodiscard]] const Eigen::MatrixXd& blockBefore() const { return block_before_; }
  [[nodiscard]] const Eigen::MatrixXd& blockOfChange() const { return block_of_change_; }
  /// D(i, i) and D(i, i − 1).
  [[nodiscard]] const Eigen::VectorXd& diagonal() const { return diagonal_; }
  [[nodiscard]] const Eigen::VectorXd& besideDiagonal() const { return beside_diagonal_; }
  /// The least variance in P⁺.
  [[nodiscard]] double leastVariance() const { return parts_[0].least_variance; }
  /// True: every entry of P⁺ is a finite number (if those of P⁻ are). False: perhaps not.
  [[nodiscard]] bool finite() const { return finite_; }

  /// Rows of the tall matrices here: N, rounded up.
  [[nodiscard]] static Eigen::Index padded(Eigen::Index rows) { return (rows + 7) / 8 * 8; }

 private:
  /// What one thread finds in its rows.
  struct Part {
    Eigen::VectorXd image;
    std::size_t next_state = 0;  ///< of states_, while rows go by
    double least_variance = 0.0;
  };

  void resize(const Transition& transition);
  void takeRows(const PackedChange& D, std::ptrdiff_t begin, std::ptrdiff_t end, Part& part);
  void gather(const double* before, const double* after, int row, Part& part);

  std::vector<int> states_;
  Eigen::MatrixXd omega_;
  Eigen::VectorXd scaled_omega_;
  std::array<Part, 2> parts_;  ///< the first one's is the whole in the end
  Eigen::MatrixXd columns_;
  Eigen::MatrixXd block_before_;
  Eigen::MatrixXd block_of_change_;
  Eigen::VectorXd diagonal_;
  Eigen::VectorXd beside_diagonal_;
  bool finite_ = false;
  std::unique_ptr<HelperThread> helper_;
};

}  // namespace slamscope::slam
