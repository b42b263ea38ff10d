// SPDX-License-Identifier: MIT
// Bugs in the prediction, equations (3) and (4).
#include <array>

#include "slam/fault_entry.hpp"

namespace slamscope::slam {
namespace {

/// P_vm is not propagated: the correlation of robot and map is as if the robot had stood still
/// (PythonRobotics #972).
class NoCrossPrediction final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  void predictCovariance(EkfState& state, const Eigen::Matrix3d& F,
                         const Eigen::Matrix3d& Q) override {
    const Eigen::MatrixXd P_mv = state.P.bottomLeftCorner(state.size() - 3, 3);
    EkfEquations::predictCovariance(state, F, Q);
    state.P.bottomLeftCorner(state.size() - 3, 3) = P_mv;
  }
};

/// The Jacobian is taken after the mean was moved, so at the new heading (PythonRobotics #305).
class LateMotionJacobian final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  Eigen::Matrix3d motionJacobian(const EkfState& state, const Motion& motion) override {
    Eigen::Matrix3d F_x;
    movePose(movePose(state.pose(), motion.increment), motion.increment, &F_x);
    return F_x;
  }
};

/// −v sin θ and v cos θ in the column of the heading became −v cos θ and v sin θ
/// (SLAM-Course-Solutions #5).
class SwappedMotionJacobian final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  Eigen::Matrix3d motionJacobian(const EkfState& state, const Motion& motion) override {
    Eigen::Matrix3d F = EkfEquations::motionJacobian(state, motion);
    const double minus_y = F(0, 2);
    const double x = F(1, 2);
    F(0, 2) = -x;
    F(1, 2) = -minus_y;
    return F;
  }
};

/// Fᵀ P F for F P Fᵀ.
class TransposedMotionJacobian final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  Eigen::Matrix3d motionJacobian(const EkfState& state, const Motion& motion) override {
    return EkfEquations::motionJacobian(state, motion).transpose();
  }
};

/// Process noise goes on the diagonal of every feature too, as if the whole state had moved.
class NoiseOnMap final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  void predictCovariance(EkfState& state, const Eigen::Matrix3d& F,
                         const Eigen::Matrix3d& Q) override {
    EkfEquations::predictCovariance(state, F, Q);
    for (int row = 3; row < state.size(); row += 2) {
      state.P(row, row) += Q(0, 0);
      state.P(row + 1, row + 1) += Q(1, 1);
    }
  }
};

/// The noise of the motion is added as it is in the body frame. What the filter declares as its Q
/// is the rotated one that it ought to add.
class UnrotatedNoise final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  Eigen::Matrix3d predict(EkfState& state, const Motion& motion) override {
    const Eigen::Matrix3d F = motionJacobian(state, motion);
    const Eigen::Matrix3d Q = processNoise(state, motion);
    predictMean(state, motion);
    predictCovariance(state, F, motion.M);
    return Q;
  }
};

constexpr std::array kMotionFaults = {
    FaultEntry{{"no-cross-prediction", "covariance of robot and map is not propagated",
                FaultKind::code, 2, FaultBlame::nobody, false, "PythonRobotics #972"},
               plant<NoCrossPrediction>},
    FaultEntry{{"motion-jacobian-late", "motion Jacobian taken at the heading after the move",
                FaultKind::code, 2, FaultBlame::nobody, false, "PythonRobotics #305"},
               plant<LateMotionJacobian>},
    FaultEntry{{"motion-jacobian-swapped", "sine and cosine swapped in the motion Jacobian",
                FaultKind::code, 2, FaultBlame::jacobian_entry, false, "SLAM-Course-Solutions #5"},
               plant<SwappedMotionJacobian>},
    FaultEntry{
        {"motion-jacobian-transposed", "P predicted as the transposed F' P F", FaultKind::code, 2},
        plant<TransposedMotionJacobian>},
    FaultEntry{{"noise-on-map", "process noise added to features", FaultKind::code, 1},
               plant<NoiseOnMap>},
    FaultEntry{{"noise-unrotated", "process noise not rotated into the map", FaultKind::statistics,
                2, FaultBlame::nobody, true},
               plant<UnrotatedNoise>},
};

}  // namespace

std::span<const FaultEntry> motionFaults() {
  return kMotionFaults;
}

}  // namespace slamscope::slam
