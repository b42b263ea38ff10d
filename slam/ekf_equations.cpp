// SPDX-License-Identifier: MIT
#include "slam/ekf_equations.hpp"

#include <algorithm>

#include "slam/angle.hpp"
#include "slam/ekf_cholesky.hpp"

namespace slamscope::slam {
namespace {

Eigen::Matrix3d poseCovariance(const EkfState& state) {
  return state.P.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>();
}

/// P Hᵀ of one observation (N×2), from the lower triangle of P: the columns of the pose and those
/// of the feature, above the diagonal read as rows.
void setPHt(const EkfState& state, const ObservationJacobian& H,
            Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, 2>> PHt) {
  const Eigen::MatrixXd& P = state.P;
  const Eigen::Index column = H.column;
  const Eigen::Index below = P.rows() - column - 2;
  const Matrix32d H_vt = H.H_v.transpose();
  const Eigen::Matrix2d H_ft = H.H_f.transpose();
  const Eigen::Matrix2d P_ff = P.block<2, 2>(column, column).selfadjointView<Eigen::Lower>();
  PHt.topRows<3>().noalias() = poseCovariance(state) * H_vt;
  PHt.bottomRows(P.rows() - 3).noalias() = P.bottomLeftCorner(P.rows() - 3, 3).lazyProduct(H_vt);
  const double* above = &P(column, 0);  // two rows of P, read once
  double* const first = PHt.col(0).data();
  double* const second = PHt.col(1).data();
  for (Eigen::Index k = 0; k < column; ++k, above += P.rows()) {
    first[k] += above[0] * H_ft(0, 0) + above[1] * H_ft(1, 0);
    second[k] += above[0] * H_ft(0, 1) + above[1] * H_ft(1, 1);
  }
  PHt.middleRows<2>(column) += P_ff * H_ft;
  PHt.bottomRows(below).noalias() += P.block(column + 2, column, below, 2).lazyProduct(H_ft);
}

/// S of (8) for all observations, whole and exactly symmetric, from P Hᵀ.
void setInnovationCovariance(Correction& c) {
  const auto count = static_cast<Eigen::Index>(c.observations.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    const LinearisedObservation& o = c.observations[static_cast<std::size_t>(k)];
    for (Eigen::Index j = 0; j <= k; ++j) {
      const Eigen::Matrix2d block =
          o.H.H_v * c.PHt.block<3, 2>(0, 2 * j) + o.H.H_f * c.PHt.block<2, 2>(o.H.column, 2 * j);
      c.S.block<2, 2>(2 * k, 2 * j) = block;
      c.S.block<2, 2>(2 * j, 2 * k) = block.transpose();
    }
    const Eigen::Matrix2d own = c.S.block<2, 2>(2 * k, 2 * k);
    c.S.block<2, 2>(2 * k, 2 * k) = 0.5 * (own + own.transpose()) + o.R;
  }
}

/// (8) and (11) of `c.observations`.
void solveCorrection(const EkfState& state, Correction& c) {
  const auto count = static_cast<Eigen::Index>(c.observations.size());
  c.innovation.resize(2 * count);
  c.PHt.resize(state.size(), 2 * count);
  c.S.resize(2 * count, 2 * count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const LinearisedObservation& o = c.observations[static_cast<std::size_t>(k)];
    c.innovation.segment<2>(2 * k) = o.innovation;
    setPHt(state, o.H, c.PHt.middleCols<2>(2 * k));
  }
  setInnovationCovariance(c);  // (8)
  c.applied = c.innovation.allFinite() && choleskyOf(c.S, c.L);
  if (!c.applied) return;
  solveFromTheRight(c.L, c.PHt, c.Y);  // (11)
}

}  // namespace

std::optional<int> EkfState::rowOf(FeatureId id) const {
  const auto found = std::find(ids.begin(), ids.end(), id);
  if (found == ids.end()) return std::nullopt;
  return Snapshot::row(static_cast<int>(found - ids.begin()));
}

void EkfState::removeAt(int row) {
  const int below = size() - row - 2;
  ids.erase(ids.begin() + (row - 3) / 2);
  x.segment(row, below) = x.tail(below).eval();
  x.conservativeResize(x.size() - 2);
  P.middleRows(row, below) = P.bottomRows(below).eval();
  P.middleCols(row, below) = P.rightCols(below).eval();
  P.conservativeResize(P.rows() - 2, P.cols() - 2);
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
  for (Eigen::Index row = 0; row < P_mv.rows(); ++row) {
    const Eigen::Vector3d P_vi = P_mv.row(row).transpose();
    P_mv.row(row).noalias() = (F * P_vi).transpose();
  }
}

std::span<const Observation> EkfEquations::perceive(const EkfState& /*state*/,
                                                    std::span<const Observation> readings) {
  return readings;
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
  const auto [H_v, H_f] = observeJacobians(sensor_, state.pose(), state.x.segment<2>(row));
  return {H_v, H_f, row};
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
  Correction correction;
  correction.observations = std::move(observations);
  solveCorrection(state, correction);
  return correction;
}

Correction EkfEquations::spare(std::size_t observations) {
  if (spares_.size() <= observations) spares_.resize(observations + 1);
  return std::move(spares_[observations]);
}

void EkfEquations::reuse(Correction&& correction) {
  const std::size_t observations = correction.observations.size();
  if (spares_.size() <= observations) spares_.resize(observations + 1);
  spares_[observations] = std::move(correction);
}

Correction EkfEquations::update(EkfState& state, std::span<const Observation> observations) {
  Correction correction = spare(observations.size());
  correction.observations.clear();
  for (const Observation& o : observations) correction.observations.push_back(linearise(state, o));
  solveCorrection(state, correction);
  if (correction.applied) {
    updateMean(state, correction);        // (9)
    updateCovariance(state, correction);  // (10)
  }
  return correction;
}

void EkfEquations::updateMean(EkfState& state, const Correction& correction) {
  const Eigen::Index rows = correction.innovation.size();
  if (whitened_.size() < rows) whitened_.resize(rows);
  auto whitened = whitened_.head(rows);
  whitened = correction.innovation;
  correction.L.triangularView<Eigen::Lower>().solveInPlace(whitened);
  state.x.noalias() += correction.Y * whitened;
  state.x[2] = wrapAngle(state.x[2]);
}

void EkfEquations::updateCovariance(EkfState& state, const Correction& correction) {
  rank_update_.subtract(state.P, correction.Y);
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
