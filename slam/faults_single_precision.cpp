// SPDX-License-Identifier: MIT
#include "slam/faults_single_precision.hpp"

#include <Eigen/Cholesky>

namespace slamscope::slam {

void SinglePrecision::predictCovariance(EkfState& state, const Eigen::Matrix3d& F,
                                        const Eigen::Matrix3d& Q) {
  const Eigen::MatrixXf F_x = F.cast<float>();
  Eigen::MatrixXf P = state.P.cast<float>();
  P.topRows(3) = F_x.lazyProduct(P.topRows(3)).eval();
  P.leftCols(3) = P.leftCols(3).lazyProduct(F_x.transpose()).eval();
  P.topLeftCorner(3, 3) += Q.cast<float>();
  state.P = P.cast<double>();
}

void SinglePrecision::updateCovariance(EkfState& state, const Correction& correction) {
  const Eigen::Index m = correction.innovation.size();
  Eigen::MatrixXf H(m, state.size());
  for (Eigen::Index k = 0; k < m / 2; ++k) {
    const ObservationJacobian& H_k = correction.observations[static_cast<std::size_t>(k)].H;
    H.middleRows<2>(2 * k) = H_k.dense(state.size()).cast<float>();
  }
  const Eigen::MatrixXf P = state.P.cast<float>();
  const Eigen::MatrixXd I_m = Eigen::MatrixXd::Identity(m, m);
  const Eigen::MatrixXf S_inverse = correction.S.llt().solve(I_m).cast<float>();
  // Coefficient by coefficient: a blocked product of floats would be compiled for this alone.
  const Eigen::MatrixXf K = P.lazyProduct(H.transpose()).eval().lazyProduct(S_inverse);
  const Eigen::MatrixXf I = Eigen::MatrixXf::Identity(state.size(), state.size());
  const Eigen::MatrixXf I_KH = I - K.lazyProduct(H);
  state.P = I_KH.lazyProduct(P).cast<double>();
}

void SinglePrecision::initialiseCovariance(EkfState& state, const Matrix23d& G_v,
                                           const Eigen::Matrix2d& G_z, const Eigen::Matrix2d& R) {
  const int old = state.size() - 2;
  const Eigen::MatrixXf G = G_v.cast<float>();
  const Eigen::Matrix2d noise = G_z * R * G_z.transpose();
  const Eigen::MatrixXf P = state.P.topLeftCorner(old, old).cast<float>();
  const Eigen::MatrixXf left = G.lazyProduct(P.topRows(3));
  const Eigen::MatrixXf right = P.leftCols(3).lazyProduct(G.transpose());
  const Eigen::MatrixXf P_ll = left.leftCols(3).lazyProduct(G.transpose());
  state.P.bottomLeftCorner(2, old) = left.cast<double>();
  state.P.topRightCorner(old, 2) = right.cast<double>();
  state.P.bottomRightCorner(2, 2) = (P_ll + noise.cast<float>()).cast<double>();
}

std::optional<double> SinglePrecision::asymmetry(const EkfState& state) const {
  return (state.P - state.P.transpose()).cwiseAbs().maxCoeff();
}

}  // namespace slamscope::slam
