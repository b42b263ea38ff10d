// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>

#include "slam/ekf_equations.hpp"

namespace slamscope::slam {

/// First-estimates Jacobians (Huang, Mourikis and Roumeliotis, "Analysis and improvement of the
/// consistency of extended Kalman filter based SLAM", ICRA 2008): H at the predicted pose and at
/// the place where each feature was first put, F by the difference of predicted poses. The filter
/// then gains no information about its heading that it can't have, which is what makes the plain
/// EKF too sure of itself on long drives. The audit's word for it is `--allow fej`.
class FirstEstimates : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  Eigen::Matrix3d motionJacobian(const EkfState& state, const Motion& motion) override;
  void predictMean(EkfState& state, const Motion& motion) override;
  ObservationJacobian observationJacobian(const EkfState& state, int row) override;
  void initialise(EkfState& state, const Observation& observation) override;

 private:
  std::optional<Eigen::Vector3d> predicted_;
  std::map<FeatureId, Eigen::Vector2d> first_;
};

}  // namespace slamscope::slam
