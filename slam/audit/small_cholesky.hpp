// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace slamscope::slam {

/// A square matrix of a few dozen rows for the functions below: stored by columns of a multiple of
/// four numbers, so that no loop has a remainder.
class SmallMatrix {
 public:
  /// Keeps its memory where that suffices; the numbers are then whatever they were.
  void resize(Eigen::Index size);

  [[nodiscard]] Eigen::Index size() const { return size_; }
  [[nodiscard]] Eigen::Index stride() const { return numbers_.rows(); }
  [[nodiscard]] double operator()(Eigen::Index row, Eigen::Index col) const {
    return numbers_(row, col);
  }
  double& operator()(Eigen::Index row, Eigen::Index col) { return numbers_(row, col); }
  [[nodiscard]] const double* column(Eigen::Index col) const { return numbers_.col(col).data(); }
  [[nodiscard]] double* column(Eigen::Index col) { return numbers_.col(col).data(); }

 private:
  Eigen::Index size_ = 0;
  Eigen::MatrixXd numbers_;
};

/// A ← L with A = L Lᵀ, reading and writing the lower triangle; above it stands no meaning then.
/// False where A is not positive definite: A is undefined.
[[nodiscard]] bool factorise(SmallMatrix& A);
/// The same of two of one size, one of which has its way while the other waits for a root.
struct Factorised {
  bool first = false;
  bool second = false;
};
[[nodiscard]] Factorised factoriseBoth(SmallMatrix& A, SmallMatrix& B);

/// vᵀ A⁻¹ v over the part of A (both triangles given) that stands out: by elimination of the
/// largest diagonal entry left over, until none exceeds `least`. A and v are used up.
struct Resolved {
  int rank = 0;
  double squared = 0.0;
};
[[nodiscard]] Resolved squaredOverResolved(SmallMatrix& A, Eigen::VectorXd& v, double least);

/// Right-hand sides, each row a column of four numbers.
using FourColumns = Eigen::Matrix<double, 4, Eigen::Dynamic>;
/// X ← A⁻¹ X by the factor L of A.
void solveFour(const SmallMatrix& L, FourColumns& X);

/// Right-hand sides of as many rows as L, in a multiple of four columns.
using ManyColumns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
/// X ← L⁻¹ X. From column `identity` on X is the identity, and zeros after it.
void solveForward(const SmallMatrix& L, ManyColumns& X, Eigen::Index identity);
/// squares(m) = Σ_i X(i, m)², along(m) = Σ_i X(i, m) X(i, column).
void squaresOf(const ManyColumns& X, Eigen::Index column, Eigen::VectorXd& squares,
               Eigen::VectorXd& along);

}  // namespace slamscope::slam
