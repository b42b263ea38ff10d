// SPDX-License-Identifier: MIT
// Filters that choose where they linearise.
#pragma once

#include "slam/angle.hpp"
#include "slam/first_estimates.hpp"
#include "tests/slam/variants/joseph.hpp"

namespace slamscope::slam::testing {

/// Iterated EKF: the observation is linearised anew at the updated mean (Gauss-Newton), P is
/// updated with the last Jacobian.
class IteratedFilter final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  Correction update(EkfState& state, std::span<const Observation> observations) override {
    const Eigen::VectorXd prior = state.x;
    EkfState at = state;
    Correction c;
    for (int iteration = 0; iteration < 4; ++iteration) {
      std::vector<LinearisedObservation> linearised;
      for (const Observation& o : observations) {
        linearised.push_back(linearise(at, o));
        Eigen::VectorXd moved = at.x - prior;
        moved[2] = wrapAngle(moved[2]);
        linearised.back().innovation += linearised.back().H.dense(at.size()) * moved;
      }
      c = correct(state, std::move(linearised));
      if (!c.applied) return c;
      at.x = prior + c.Y * c.L.triangularView<Eigen::Lower>().solve(c.innovation);
      at.x[2] = wrapAngle(at.x[2]);
    }
    state.x = at.x;
    updateCovariance(state, c);
    return c;
  }
};

using FirstEstimatesFilter = FirstEstimates;

/// Sequential updates that all keep the linearisation at the mean after the last prediction.
class FrozenFilter final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  Eigen::Matrix3d predict(EkfState& state, const Motion& motion) override {
    const Eigen::Matrix3d Q = EkfEquations::predict(state, motion);
    frozen_ = state.x;
    return Q;
  }

  ObservationJacobian observationJacobian(const EkfState& state, int row) override {
    return EkfEquations::observationJacobian(at(state, row), row);
  }

  Eigen::Vector2d innovation(const EkfState& state, int row, const Eigen::Vector2d& z) override {
    const EkfState frozen = at(state, row);
    Eigen::VectorXd moved = state.x - frozen.x;
    moved[2] = wrapAngle(moved[2]);
    return EkfEquations::innovation(frozen, row, z) -
           EkfEquations::observationJacobian(frozen, row).dense(state.size()) * moved;
  }

 private:
  /// Features that were born since then have no older place.
  [[nodiscard]] EkfState at(const EkfState& state, int row) const {
    EkfState frozen;
    frozen.x = state.x;
    if (row < frozen_.size()) frozen.x.head(frozen_.size()) = frozen_;
    return frozen;
  }

  Eigen::VectorXd frozen_;
};

}  // namespace slamscope::slam::testing
