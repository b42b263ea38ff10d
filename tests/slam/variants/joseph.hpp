// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>

#include "slam/ekf_equations.hpp"

namespace slamscope::slam::testing {

/// H of all observations of a correction, 2m×N.
inline Eigen::MatrixXd denseH(const Correction& correction, int size) {
  Eigen::MatrixXd H(correction.innovation.size(), size);
  Eigen::Index row = 0;
  for (const LinearisedObservation& o : correction.observations) {
    H.middleRows<2>(row) = o.H.dense(size);
    row += 2;
  }
  return H;
}

/// R of all observations, 2m×2m.
inline Eigen::MatrixXd denseR(const Correction& correction) {
  Eigen::MatrixXd R =
      Eigen::MatrixXd::Zero(correction.innovation.size(), correction.innovation.size());
  Eigen::Index row = 0;
  for (const LinearisedObservation& o : correction.observations) {
    R.block<2, 2>(row, row) = o.R;
    row += 2;
  }
  return R;
}

inline Eigen::MatrixXd wholeP(const EkfState& state) {
  return state.P.selfadjointView<Eigen::Lower>();
}

/// Joseph's form, (I − K H) P (I − K H)ᵀ + K R Kᵀ, written out as the full matrix with the
/// asymmetry that rounding leaves.
class JosephForm final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  void updateCovariance(EkfState& state, const Correction& correction) override {
    const Eigen::MatrixXd H = denseH(correction, state.size());
    const Eigen::MatrixXd P = wholeP(state);
    const Eigen::MatrixXd K = correction.S.llt().solve(H * P).transpose();
    const Eigen::MatrixXd I_KH = Eigen::MatrixXd::Identity(state.size(), state.size()) - K * H;
    const Eigen::MatrixXd updated =
        I_KH * P * I_KH.transpose() + K * denseR(correction) * K.transpose();
    asymmetry_ = (updated - updated.transpose()).cwiseAbs().maxCoeff();
    state.P = updated;
  }

  [[nodiscard]] std::optional<double> asymmetry(const EkfState& /*state*/) const override {
    return asymmetry_;
  }

 private:
  double asymmetry_ = 0.0;
};

}  // namespace slamscope::slam::testing
