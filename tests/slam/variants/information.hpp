// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>

#include "slam/angle.hpp"
#include "tests/slam/variants/joseph.hpp"

namespace slamscope::slam::testing {

/// Update in the information form: P⁺ = (P⁻¹ + Hᵀ R⁻¹ H)⁻¹, x⁺ = x⁻ + P⁺ Hᵀ R⁻¹ ν. Needs a regular
/// P, so a start pose that is not exactly known.
class InformationForm final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  void updateMean(EkfState& state, const Correction& correction) override {
    const Eigen::MatrixXd H = denseH(correction, state.size());
    const Eigen::MatrixXd HtRinv = denseR(correction).llt().solve(H).transpose();
    const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(state.size(), state.size());
    const Eigen::MatrixXd Y = wholeP(state).llt().solve(I) + HtRinv * H;
    P_ = Y.llt().solve(I);
    state.x += P_ * (HtRinv * correction.innovation);
    state.x[2] = wrapAngle(state.x[2]);
  }

  void updateCovariance(EkfState& state, const Correction& /*correction*/) override {
    state.P = P_;
  }

 private:
  Eigen::MatrixXd P_;
};

}  // namespace slamscope::slam::testing
