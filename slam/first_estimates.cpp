// SPDX-License-Identifier: MIT
#include "slam/first_estimates.hpp"

namespace slamscope::slam {

Eigen::Matrix3d FirstEstimates::motionJacobian(const EkfState& state, const Motion& motion) {
  const Eigen::Vector2d from = predicted_.value_or(state.pose()).head<2>();
  const Eigen::Vector2d shift = movePose(state.pose(), motion.increment).head<2>() - from;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 2) = -shift.y();
  F(1, 2) = shift.x();
  return F;
}

void FirstEstimates::predictMean(EkfState& state, const Motion& motion) {
  EkfEquations::predictMean(state, motion);
  predicted_ = state.pose();
}

ObservationJacobian FirstEstimates::observationJacobian(const EkfState& state, int row) {
  const auto first = first_.find(state.ids[static_cast<std::size_t>((row - 3) / 2)]);
  const Eigen::Vector2d feature =
      first == first_.end() ? Eigen::Vector2d(state.x.segment<2>(row)) : first->second;
  const auto [H_v, H_f] = observeJacobians(sensor(), predicted_.value_or(state.pose()), feature);
  return {H_v, H_f, row};
}

void FirstEstimates::initialise(EkfState& state, const Observation& observation) {
  EkfEquations::initialise(state, observation);
  first_[observation.id] = state.x.tail<2>();
}

}  // namespace slamscope::slam
