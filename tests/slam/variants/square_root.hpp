// SPDX-License-Identifier: MIT
#pragma once

#include "slam/angle.hpp"
#include "tests/slam/variants/joseph.hpp"

namespace slamscope::slam::testing {

/// Some B with B Bᵀ = P, for any P ⪰ 0.
inline Eigen::MatrixXd squareRoot(const Eigen::MatrixXd& P) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(P);
  return eigen.eigenvectors() *
         eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal().toDenseMatrix();
}

/// A filter that carries a factor L of P = L Lᵀ from event to event and never computes with P
/// itself: array algorithms by QR.
class SquareRootForm final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  void predictCovariance(EkfState& state, const Eigen::Matrix3d& F,
                         const Eigen::Matrix3d& Q) override {
    refresh(state);
    Eigen::MatrixXd array(state.size(), L_.cols() + 3);
    array << L_, Eigen::MatrixXd::Zero(state.size(), 3);
    array.topRows<3>() = (F * array.topRows<3>()).eval();
    array.topRightCorner<3, 3>() = squareRoot(Q);
    L_ = triangular(array);
    state.P = L_ * L_.transpose();
  }

  void updateMean(EkfState& state, const Correction& correction) override {
    refresh(state);
    const Eigen::Index m = correction.innovation.size();
    const Eigen::Index n = state.size();
    Eigen::MatrixXd array = Eigen::MatrixXd::Zero(m + n, m + n);
    array.topLeftCorner(m, m) = squareRoot(denseR(correction));
    array.topRightCorner(m, n) = denseH(correction, state.size()) * L_;
    array.bottomRightCorner(n, n) = L_;
    const Eigen::MatrixXd post = triangular(array);  // [S½ 0; K S½ L⁺]
    const auto S_root = post.topLeftCorner(m, m).triangularView<Eigen::Lower>();
    state.x += post.bottomLeftCorner(n, m) * S_root.solve(correction.innovation);
    state.x[2] = wrapAngle(state.x[2]);
    L_ = post.bottomRightCorner(n, n);
  }

  void updateCovariance(EkfState& state, const Correction& /*correction*/) override {
    state.P = L_ * L_.transpose();
  }

  void initialiseCovariance(EkfState& state, const Matrix23d& G_v, const Eigen::Matrix2d& G_z,
                            const Eigen::Matrix2d& R) override {
    const Eigen::Index old = state.size() - 2;
    if (L_.rows() != old) L_ = squareRoot(wholeP(state).topLeftCorner(old, old));
    Eigen::MatrixXd grown = Eigen::MatrixXd::Zero(old + 2, old + 2);
    grown.topLeftCorner(old, old) = L_;
    grown.bottomLeftCorner(2, old) = G_v * L_.topRows<3>();
    grown.bottomRightCorner<2, 2>() = G_z * squareRoot(R);
    L_ = grown;
    state.P = L_ * L_.transpose();
  }

 private:
  /// At the start, and after a removal.
  void refresh(const EkfState& state) {
    if (L_.rows() != state.size()) L_ = squareRoot(wholeP(state));
  }

  /// Lower triangular T with T Tᵀ = A Aᵀ.
  static Eigen::MatrixXd triangular(const Eigen::MatrixXd& A) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A.transpose());
    const Eigen::MatrixXd upper = qr.matrixQR().topRows(A.rows()).triangularView<Eigen::Upper>();
    return upper.transpose();
  }

  Eigen::MatrixXd L_;
};

}  // namespace slamscope::slam::testing
