// SPDX-License-Identifier: MIT
#include "slam/ekf_equations.hpp"

#include <algorithm>

#include "slam/angle.hpp"
#include "slam/ekf_rank_update.hpp"

namespace slamscope::slam {
namespace {

Eigen::Matrix3d poseCovariance(const EkfState& state) {
  return state.P.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>();
}

/// Columns `column` … `column` + Count − 1 of the symmetric P, read from its lower triangle.
template <int Count>
Eigen::Matrix<double, Eigen::Dynamic, Count> columnsOf(const Eigen::MatrixXd& P, int column) {
  const Eigen::Index below = P.rows() - column;
  Eigen::Matrix<double, Eigen::Dynamic, Count> columns(P.rows(), Count);
  columns.topRows(column) = P.block(column, 0, Count, column).transpose();
  columns.bottomRows(below) = P.block(column, column, below, Count);
  const Eigen::Matrix<double, Count, Count> corner =
      P.block<Count, Count>(column, column).template selfadjointView<Eigen::Lower>();
  columns.template middleRows<Count>(column) = corner;
  return columns;
}

}  // namespace

std::optional<int> EkfState::rowOf(FeatureId id) const {
  const auto found = std::find(ids.begin(), ids.end(), id);
  if (found == ids.end()) return std::nullopt;
  return Snapshot::row(static_cast<int>(found - ids.begin()));
}

Eigen::MatrixXd ObservationJacobian::dense(int size) const {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2, size);
  H.leftCols<3>() = H_v;
  H.middleCols<2>(column) = H_f;
  return H;
}

Eigen::Matrix3d EkfEquations::predict(EkfState& state, const Motion& motion) {
  const Eigen::Matrix3d F = motionJacobian(state, motion);
  const Eigen::Matrix3d Q = processNoise(state, motion);
  predictMean(state, motion);      // (3)
  predictCovariance(state, F, Q);  // (4)
  return Q;
}

void EkfEquations::predictMean(EkfState& state, const Motion& motion) {
  state.x.head<3>() = movePose(state.pose(), motion.increment);
}

Eigen::Matrix3d EkfEquations::motionJacobian(const EkfState& state, const Motion& motion) {
  Eigen::Matrix3d F_x;
  movePose(state.pose(), motion.increment, &F_x);
  return F_x;
}

Eigen::Matrix3d EkfEquations::processNoise(const EkfState& state, const Motion& motion) {
  Eigen::Matrix3d G_u;
  movePose(state.pose(), motion.increment, nullptr, &G_u);
  return G_u * motion.M * G_u.transpose();
}

void EkfEquations::predictCovariance(EkfState& state, const Eigen::Matrix3d& F,
                                     const Eigen::Matrix3d& Q) {
  const Eigen::Matrix3d P_vv = F * poseCovariance(state) * F.transpose() + Q;
  state.P.topLeftCorner<3, 3>().triangularView<Eigen::Lower>() = P_vv;
  auto P_mv = state.P.bottomLeftCorner(state.size() - 3, 3);
  P_mv = (P_mv * F.transpose()).eval();
}

std::vector<Observation> EkfEquations::perceive(const EkfState& /*state*/,
                                                std::span<const Observation> readings) {
  return {readings.begin(), readings.end()};
}

Eigen::Matrix2d EkfEquations::observationNoise(const Eigen::Matrix2d& R) {
  return R;
}

Eigen::Vector2d EkfEquations::innovation(const EkfState& state, int row, const Eigen::Vector2d& z) {
  const Eigen::Vector2d z_predicted =
      observeFeature(sensor_, state.pose(), state.x.segment<2>(row));  // (6)
  return observationDifference(sensor_, z, z_predicted);               // (7)
}

ObservationJacobian EkfEquations::observationJacobian(const EkfState& state, int row) {
  ObservationJacobian H;
  H.column = row;
  observeFeature(sensor_, state.pose(), state.x.segment<2>(row), &H.H_v, &H.H_f);
  return H;
}

LinearisedObservation EkfEquations::linearise(const EkfState& state,
                                              const Observation& observation) {
  const int row = state.rowOf(observation.id).value();
  return {observation.id, observation.z, innovation(state, row, observation.z),
          observationJacobian(state, row), observationNoise(observation.R)};
}

Eigen::Matrix2d EkfEquations::innovationCovariance(const EkfState& state,
                                                   const LinearisedObservation& observation) const {
  const auto& [H_v, H_f, column] = observation.H;
  const Eigen::Matrix<double, 2, 3> P_fv = state.P.block<2, 3>(column, 0);
  const Eigen::Matrix2d P_ff = state.P.block<2, 2>(column, column).selfadjointView<Eigen::Lower>();
  const Eigen::Matrix2d cross = H_f * P_fv * H_v.transpose();
  return H_v * poseCovariance(state) * H_v.transpose() + cross + cross.transpose() +
         H_f * P_ff * H_f.transpose() + observation.R;  // (8)
}

Correction EkfEquations::correct(const EkfState& state,
                                 std::vector<LinearisedObservation> observations) const {
  const auto count = static_cast<Eigen::Index>(observations.size());
  Correction c;
  c.observations = std::move(observations);
  c.innovation.resize(2 * count);
  c.PHt.resize(state.size(), 2 * count);
  c.S.resize(2 * count, 2 * count);
  const Eigen::Matrix<double, Eigen::Dynamic, 3> P_v = columnsOf<3>(state.P, 0);
  for (Eigen::Index k = 0; k < count; ++k) {
    const LinearisedObservation& o = c.observations[static_cast<std::size_t>(k)];
    c.innovation.segment<2>(2 * k) = o.innovation;
    c.PHt.middleCols<2>(2 * k) = P_v.lazyProduct(o.H.H_v.transpose());
    c.PHt.middleCols<2>(2 * k) +=
        columnsOf<2>(state.P, o.H.column).lazyProduct(o.H.H_f.transpose());
  }
  for (Eigen::Index k = 0; k < count; ++k) {  // (8)
    const LinearisedObservation& o = c.observations[static_cast<std::size_t>(k)];
    c.S.middleRows<2>(2 * k) = o.H.H_v.lazyProduct(c.PHt.topRows<3>()) +
                               o.H.H_f.lazyProduct(c.PHt.middleRows<2>(o.H.column));
    c.S.block<2, 2>(2 * k, 2 * k) += o.R;
  }
  c.S = (0.5 * (c.S + c.S.transpose())).eval();
  c.S_factor.compute(c.S);
  c.applied = c.S.allFinite() && c.innovation.allFinite() && c.S_factor.info() == Eigen::Success;
  if (!c.applied) return c;
  c.Y = c.PHt;  // (11)
  c.S_factor.matrixU().solveInPlace<Eigen::OnTheRight>(c.Y);
  return c;
}

Correction EkfEquations::update(EkfState& state, std::span<const Observation> observations) {
  std::vector<LinearisedObservation> linearised;
  linearised.reserve(observations.size());
  for (const Observation& o : observations) linearised.push_back(linearise(state, o));
  Correction correction = correct(state, std::move(linearised));
  if (correction.applied) {
    updateMean(state, correction);        // (9)
    updateCovariance(state, correction);  // (10)
  }
  return correction;
}

void EkfEquations::updateMean(EkfState& state, const Correction& correction) {
  state.x += correction.Y * correction.S_factor.matrixL().solve(correction.innovation);
  state.x[2] = wrapAngle(state.x[2]);
}

void EkfEquations::updateCovariance(EkfState& state, const Correction& correction) {
  subtractOuterProduct(state.P, correction.Y);
}

void EkfEquations::initialise(EkfState& state, const Observation& observation) {
  Matrix23d G_v;
  Eigen::Matrix2d G_z;
  const Eigen::Vector2d feature = locateFeature(sensor_, state.pose(), observation.z, &G_v, &G_z);
  const int row = state.size();
  state.ids.push_back(observation.id);
  state.x.conservativeResize(row + 2);
  state.x.tail<2>() = feature;
  state.P.conservativeResize(row + 2, row + 2);
  initialiseCovariance(state, G_v, G_z, observationNoise(observation.R));
}

void EkfEquations::initialiseCovariance(EkfState& state, const Matrix23d& G_v,
                                        const Eigen::Matrix2d& G_z, const Eigen::Matrix2d& R) {
  const int row = state.size() - 2;
  const Matrix23d P_fv = G_v * poseCovariance(state);
  state.P.block(row, 3, 2, row - 3) = G_v * state.P.block(3, 0, row - 3, 3).transpose();
  state.P.block<2, 3>(row, 0) = P_fv;
  state.P.block<2, 2>(row, row) = P_fv * G_v.transpose() + G_z * R * G_z.transpose();
}

std::optional<double> EkfEquations::asymmetry(const EkfState& /*state*/) const {
  return std::nullopt;
}

}  // namespace slamscope::slam
