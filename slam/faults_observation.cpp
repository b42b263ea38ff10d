// SPDX-License-Identifier: MIT
// Bugs in the observation's Jacobian, equation (8), and in the initialisation of features.
#include <algorithm>
#include <array>

#include "slam/fault_entry.hpp"

namespace slamscope::slam {
namespace {

/// ∂bearing/∂θ = −1/q, q the squared range: the factor that the other columns share was taken out
/// of this one too (PythonRobotics #255).
class BearingJacobianOverQ final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  ObservationJacobian observationJacobian(const EkfState& state, int row) override {
    ObservationJacobian H = EkfEquations::observationJacobian(state, row);
    H.H_v(1, 2) /= (state.x.segment<2>(row) - state.x.head<2>()).squaredNorm();
    return H;
  }
};

/// ∂bearing/∂θ = +1.
class BearingJacobianSign final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  ObservationJacobian observationJacobian(const EkfState& state, int row) override {
    ObservationJacobian H = EkfEquations::observationJacobian(state, row);
    H.H_v(1, 2) = -H.H_v(1, 2);
    return H;
  }
};

/// The Jacobian is evaluated at the state from before the prediction.
class StaleLinearisation final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  void predictMean(EkfState& state, const Motion& motion) override {
    old_x_ = state.x;
    EkfEquations::predictMean(state, motion);
  }

  ObservationJacobian observationJacobian(const EkfState& state, int row) override {
    EkfState old;
    old.x = state.x;
    // A feature that is younger than that state has no old place.
    old.x.head(std::min(old_x_.size(), state.x.size())) =
        old_x_.head(std::min(old_x_.size(), state.x.size()));
    return EkfEquations::observationJacobian(old, row);
  }

 private:
  Eigen::VectorXd old_x_;
};

/// The columns of the next feature are written; the last one's wrap to the one before it.
class WrongBlock final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  ObservationJacobian observationJacobian(const EkfState& state, int row) override {
    ObservationJacobian H = EkfEquations::observationJacobian(state, row);
    if (row + 2 < state.size()) {
      H.column = row + 2;
    } else if (row > 3) {
      H.column = row - 2;
    }
    return H;
  }
};

/// A new feature gets its own covariance but none with robot and map (mobilerobotics #37).
class UncorrelatedFeature final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  void initialiseCovariance(EkfState& state, const Matrix23d& G_v, const Eigen::Matrix2d& G_z,
                            const Eigen::Matrix2d& R) override {
    EkfEquations::initialiseCovariance(state, G_v, G_z, R);
    state.P.bottomLeftCorner(2, state.size() - 2).setZero();
  }
};

/// A new feature gets the identity (1 m²) as its covariance, and none with robot and map.
class IdentityFeature final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  void initialiseCovariance(EkfState& state, const Matrix23d& /*G_v*/,
                            const Eigen::Matrix2d& /*G_z*/, const Eigen::Matrix2d& /*R*/) override {
    state.P.bottomLeftCorner(2, state.size() - 2).setZero();
    state.P.bottomRightCorner<2, 2>().setIdentity();
  }
};

constexpr std::array kObservationFaults = {
    FaultEntry{{"bearing-jacobian-1q", "derivative of the bearing by the heading is -1/q, not -1",
                FaultKind::code, 2, FaultBlame::nobody, false, "PythonRobotics #255"},
               plantInBearing<BearingJacobianOverQ>},
    FaultEntry{{"bearing-jacobian-sign", "derivative of the bearing by the heading is +1, not -1",
                FaultKind::code, 2},
               plantInBearing<BearingJacobianSign>},
    FaultEntry{{"stale-linearisation", "observation Jacobian at the state before the prediction",
                FaultKind::code, 2},
               plant<StaleLinearisation>},
    FaultEntry{{"wrong-block", "observation Jacobian written to the next feature's columns",
                FaultKind::code, 2, FaultBlame::written_block},
               plant<WrongBlock>},
    FaultEntry{{"initialise-uncorrelated", "a new feature has no covariance with robot and map",
                FaultKind::code, 2, FaultBlame::new_features, false, "mobilerobotics #37"},
               plant<UncorrelatedFeature>},
    FaultEntry{{"initialise-identity", "a new feature has the identity as its covariance",
                FaultKind::code, 2, FaultBlame::new_features},
               plant<IdentityFeature>},
};

}  // namespace

std::span<const FaultEntry> observationFaults() {
  return kObservationFaults;
}

}  // namespace slamscope::slam
