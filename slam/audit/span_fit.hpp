// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "slam/audit/transition.hpp"

namespace slamscope::slam {

/// Vectors that the columns of D may be made of, each row scaled by 1/√diag P⁻.
struct SpanBasis {
  int begin = 0;          ///< first state looked at: 0, or 3 for the map alone
  Eigen::MatrixXd W;      ///< a row for each state from `begin`, a column for each vector
  Eigen::VectorXd noise;  ///< error of each entry of a column
};

/// P⁻B_iᵀ of each given feature, B_i = [−I, −J δ_i, I] with δ_i = l_i − p: two columns each. Any H
/// of relative sensing is H_i = A_i B_i, so these span what an update may touch. `deltas`: one a
/// feature.
[[nodiscard]] SpanBasis observationBasis(const Transition& transition,
                                         const std::vector<int>& features,
                                         const std::vector<Eigen::Vector2d>& deltas);

/// What remains without knowing where the filter linearised: P⁻[−I, 0, I]ᵀ of each feature and
/// P⁻e_θ. From state `begin` on.
[[nodiscard]] SpanBasis looseBasis(const Transition& transition, const std::vector<int>& features,
                                   int begin);

/// l_i − p of each feature at the mean before the update.
[[nodiscard]] std::vector<Eigen::Vector2d> lawfulDeltas(const Snapshot& snapshot,
                                                        const std::vector<int>& features);

/// D seen through a few random vectors: `Y` = D `Omega`, scaled, rows from state `begin`.
struct ProbedChange {
  int begin = 0;
  Eigen::MatrixXd Omega;
  Eigen::MatrixXd Y;
};
[[nodiscard]] ProbedChange probeChange(const Transition& transition, int begin, int count);

/// A basis by orthonormal columns: the resolved directions of a SpanBasis.
struct OrthonormalSpan {
  Eigen::MatrixXd Q;  ///< columns orthonormal
  Eigen::MatrixXd R;  ///< vectors of the basis, of unit length, in some order = Q R; upper triangle
  Eigen::VectorXd noise;     ///< error of an entry of those vectors
  bool all_resolved = true;  ///< no direction drowns in the noise
};

/// QR of the basis, rows `without` set to zero: by Cholesky's factor of WᵀW, twice, where W is well
/// conditioned (Fukaya et al. 2014, "CholeskyQR2": as orthogonal as Householder's and several times
/// quicker), else by pivoted Householder QR.
[[nodiscard]] OrthonormalSpan orthonormal(const SpanBasis& basis,
                                          const std::vector<int>& without = {});

struct SpanFit {
  bool whole = false;      ///< every column of D lies in the span
  bool checkable = false;  ///< a part of 5 % outside would have been seen
  double residual = 0.0;   ///< largest part outside, of the largest entry
  double tolerance = 0.0;
  Eigen::MatrixXd outside;  ///< residual of Y by state
};

/// What may be left outside of a span of an image whose largest entry is `size`: 8 times the error
/// that independent roundings leave, and what other forms of the update lose.
[[nodiscard]] inline double spanTolerance(double error, double size) {
  return 8.0 * error + 1e-6 * size;
}

/// Whether the columns of D lie in the span, but for rows and columns of `without` (states, those
/// before basis.begin are left out anyway). Tolerance: the error that
/// rounding of D and of the basis can leave.
[[nodiscard]] SpanFit fitSpan(const Transition& transition, const ProbedChange& change,
                              const SpanBasis& basis, const std::vector<int>& without = {});
/// The same with the basis made orthonormal before; `span` leaves out `without` too.
[[nodiscard]] SpanFit fitSpan(const Transition& transition, const ProbedChange& change,
                              const OrthonormalSpan& span, const std::vector<int>& without = {});

/// Features, or the robot alone (−1), whose rows and columns of D, taken out, leave the rest whole:
/// those whose variance grows, and the fewest others that a greedy search finds, up to `most` in
/// all. Where none suffice, those whose variance grows; may be empty.
[[nodiscard]] std::vector<int> culprits(const Transition& transition, const ProbedChange& change,
                                        const SpanBasis& basis, int most);

/// States of a block: a feature's two or (−1) the robot's three.
[[nodiscard]] std::vector<int> statesOf(const std::vector<int>& blocks);

}  // namespace slamscope::slam
