// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "slam/angle.hpp"
#include "tests/slam/variants/joseph.hpp"
#include "tests/slam/variants/variants.hpp"

namespace slamscope::slam::testing {

/// What an absolute sensor reads, set by whoever drives the run.
/// Every update also takes in the heading that a compass reads.
class CompassAidedFilter final : public EkfEquations {
 public:
  CompassAidedFilter(Sensor sensor, std::shared_ptr<const Compass> compass)
      : EkfEquations(sensor), compass_(std::move(compass)) {}

  Correction update(EkfState& state, std::span<const Observation> observations) override {
    Correction correction = EkfEquations::update(state, observations);
    const Eigen::VectorXd column = wholeP(state).col(2);
    const double S = column[2] + compass_->sigma * compass_->sigma;
    state.x += column * (wrapAngle(compass_->heading - state.x[2]) / S);
    state.x[2] = wrapAngle(state.x[2]);
    state.P.selfadjointView<Eigen::Lower>().rankUpdate(column, -1.0 / S);
    return correction;
  }

 private:
  std::shared_ptr<const Compass> compass_;
};

/// A new feature starts with a very large covariance and no correlation; the reading it was seen by
/// is then used in an update.
class DiffuseFilter final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  std::span<const Observation> perceive(const EkfState& state,
                                        std::span<const Observation> readings) override {
    perceived_.assign(readings.begin(), readings.end());
    for (const Observation& o : readings) {
      if (!state.rowOf(o.id)) perceived_.push_back(o);  // the second one becomes an update
    }
    return perceived_;
  }

  void initialiseCovariance(EkfState& state, const Matrix23d& /*G_v*/,
                            const Eigen::Matrix2d& /*G_z*/, const Eigen::Matrix2d& /*R*/) override {
    state.P.bottomLeftCorner(2, state.size() - 2).setZero();
    state.P.bottomRightCorner<2, 2>() = 1e4 * Eigen::Matrix2d::Identity();
  }

 private:
  std::vector<Observation> perceived_;
};

}  // namespace slamscope::slam::testing
