// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// How exact the numbers are that the laws compare.
struct Exactness {
  /// Error of an entry of P scaled by √diag: rounding of the log, or of the filter's own arithmetic
  /// where that is coarser.
  double covariance = 1e-11;
  double covariance_absolute = 0.0;  ///< m², of logs with a fixed number of decimals
  double mean = 1e-15;               ///< of a mean, relative
  double mean_absolute = 0.0;        ///< m or rad
  bool rounded = false;              ///< the log holds less than doubles
};

/// Two records that follow one another, with all features of one order: the states that both hold
/// come first, in the same order, in both. P⁻ and x⁻ are of `before`, P⁺ and x⁺ of `after`.
struct Transition {
  SnapshotPtr before;
  SnapshotPtr after;
  int shared = 0;         ///< features in both: the first `shared` of each
  Eigen::VectorXd sigma;  ///< √diag P⁻ of robot and shared features, N
  Eigen::VectorXd scale;  ///< 1 / sigma; 0 for a state that is known exactly
  double largest_scale = 0.0;
  double noise = 1e-11;     ///< error of an entry of P⁻ or P⁺, scaled by √diag
  double mean_noise = 0.0;  ///< error of a mean (m or rad)
  bool rounded = false;
  std::vector<int> observed;  ///< places of the observed features among the shared ones, sorted
  bool observed_given = false;

  [[nodiscard]] int size() const { return 3 + 2 * shared; }
  [[nodiscard]] FeatureId id(int index) const {
    return before->ids[static_cast<std::size_t>(index)];
  }
  /// x⁺ − x⁻ of robot and shared features, the heading's wrapped.
  [[nodiscard]] Eigen::VectorXd meanChange() const;
  /// Column of P⁻ (rows of robot and shared features), each row scaled.
  [[nodiscard]] Eigen::VectorXd scaledColumn(int column) const;
  /// Columns and rows `states` of D = P⁻ − P⁺, scaled.
  [[nodiscard]] Eigen::MatrixXd scaledBlock(const std::vector<int>& states) const;
  /// D(i, j), scaled.
  [[nodiscard]] double change(int i, int j) const {
    return (before->covariance(i, j) - after->covariance(i, j)) * scale[i] * scale[j];
  }
};

/// Lines the two records up. Where features were removed, or stand in another order, both are
/// copied into a common order; else the records themselves are used.
[[nodiscard]] Transition lineUp(const SnapshotPtr& before, const SnapshotPtr& after,
                                const Exactness& exactness);

/// (D W) of the scaled D = P⁻ − P⁺ for states `begin` … size − 1; W has a row for each. One pass
/// over P⁻ and P⁺ a column.
[[nodiscard]] Eigen::MatrixXd changeTimes(const Transition& transition, int begin,
                                          const Eigen::MatrixXd& W);

/// W ← random signs with random sizes in [0.5, 1.5], always the same for the same seed.
void fillProbes(std::uint64_t seed, Eigen::Index rows, Eigen::Index count, Eigen::MatrixXd& W);

}  // namespace slamscope::slam
