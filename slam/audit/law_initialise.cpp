// SPDX-License-Identifier: MIT
#include "slam/audit/law_initialise.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "slam/models.hpp"

namespace slamscope::slam {
namespace {

Matrix23d jacobian(const Snapshot& s, int index) {
  const Eigen::Vector2d d = s.features[static_cast<std::size_t>(index)] - s.pose.head<2>();
  Matrix23d G;
  G << 1.0, 0.0, -d.y(), 0.0, 1.0, d.x();
  return G;
}

struct Cross {
  double off = 0.0;    ///< worst difference from G P_v, scaled
  double size = 0.0;   ///< largest lawful entry, scaled
  double given = 0.0;  ///< largest entry found, scaled
  Evidence worst;
};

/// P_l,old against G P_v,old for the states before `end`.
Cross crossOf(const Snapshot& s, int index, int end) {
  Cross cross;
  const Matrix23d G = jacobian(s, index);
  const int row = Snapshot::row(index);
  for (int j = 0; j < end; ++j) {
    if (j >= row && j < row + 2) continue;
    const Eigen::Vector3d P_vj(s.covariance(0, j), s.covariance(1, j), s.covariance(2, j));
    const Eigen::Vector2d lawful = G * P_vj;
    for (int axis = 0; axis < 2; ++axis) {
      const double unit = std::sqrt(s.covariance(row + axis, row + axis) * s.covariance(j, j));
      if (!(unit > 0.0)) continue;
      const double given = s.covariance(row + axis, j);
      cross.size = std::max(cross.size, std::abs(lawful[axis]) / unit);
      cross.given = std::max(cross.given, std::abs(given) / unit);
      if (std::abs(given - lawful[axis]) / unit <= cross.off) continue;
      cross.off = std::abs(given - lawful[axis]) / unit;
      cross.worst = {"P(" + std::to_string(row + axis + 1) + "," + std::to_string(j + 1) + ")",
                     given, lawful[axis]};
    }
  }
  return cross;
}

/// The reading's noise brought to the map, A⁻¹ R A⁻ᵀ.
std::optional<Eigen::Matrix2d> lawfulNoise(const Snapshot& s, int index, Sensor sensor,
                                           const std::optional<Eigen::Matrix2d>& R) {
  if (!R || sensor == Sensor::unknown) return std::nullopt;
  const Eigen::Matrix2d A =
      observeJacobians(sensor, s.pose, s.features[static_cast<std::size_t>(index)]).H_f;
  if (!A.allFinite()) return std::nullopt;
  const Eigen::Matrix2d A_inverse = A.inverse();
  return Eigen::Matrix2d(A_inverse * *R * A_inverse.transpose());
}

bool isRound(const Eigen::Matrix2d& P) {
  return P(0, 0) == P(1, 1) && P(1, 0) == 0.0;
}

Outcome judgeFeature(const Transition& t, int index, int end, Sensor sensor,
                     const std::optional<Eigen::Matrix2d>& R, InitialiseCheck& check) {
  const Snapshot& s = *t.after;
  const int row = Snapshot::row(index);
  const Matrix23d G = jacobian(s, index);
  const Eigen::Matrix2d P_ll = s.covariance.block2(row, row);
  const Eigen::Matrix2d from_pose = G * s.poseCovariance() * G.transpose();
  const Cross cross = crossOf(s, index, end);
  const double unit = std::max(P_ll.trace(), 1e-300);
  const double tolerance =
      1e-6 + 24.0 * t.noise + 8.0 * t.mean_noise * t.sigma[2] / std::sqrt(unit);
  if (cross.given == 0.0 && isRound(P_ll) && P_ll(0, 0) > 99.0 &&
      P_ll(0, 0) > 99.0 * from_pose.trace()) {
    check.allow = "diffuse-initialisation";
    return Outcome::notCheckable(
        "a huge round covariance to begin with, as with "
        "--allow diffuse-initialisation");
  }
  Outcome outcome = Outcome::of(cross.off, tolerance);
  if (outcome.violated()) {
    outcome.show(cross.worst.what, cross.worst.given, cross.worst.lawful);
    outcome.amount = "the cross-covariance of a new feature is not G P_v";
    if (cross.given <= tolerance) outcome.patterns.emplace_back("initialise-uncorrelated");
  }
  const Eigen::Matrix2d noise = P_ll - from_pose;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(noise),
                                                             Eigen::EigenvaluesOnly);
  const double least = eigen.eigenvalues()[0] / unit;
  const std::optional<Eigen::Matrix2d> lawful = lawfulNoise(s, index, sensor, R);
  const double off = lawful ? (noise - *lawful).cwiseAbs().maxCoeff() / unit : 0.0;
  if (least < -tolerance || off > 1e-5 + tolerance) {
    if (!outcome.violated())
      outcome.amount = "the covariance of a new feature is not G P_vv G^T + noise";
    outcome.residual = std::max({outcome.residual, -least, off});
    outcome.show("P(" + std::to_string(row + 1) + "," + std::to_string(row + 1) + ")", P_ll(0, 0),
                 lawful ? from_pose(0, 0) + (*lawful)(0, 0) : from_pose(0, 0));
  }
  // The identity can be lawful: at an exactly known pose, or where the reading's noise is it.
  const bool identity = isRound(P_ll) && P_ll(0, 0) == 1.0;
  if (identity && (lawful ? off > 1e-5 + tolerance : !from_pose.isZero(0.0))) {
    outcome.residual = std::max(outcome.residual, 1.0);
    if (outcome.amount.empty()) outcome.amount = "the covariance of a new feature is the identity";
    outcome.patterns.emplace_back("initialise-identity");
  }
  return outcome;
}

/// What was in the map before must stay as it was.
double changeOfOld(const Transition& t) {
  double worst = 0.0;
  for (int i = 0; i < t.size(); ++i) {
    worst = std::max(worst, std::abs(t.change(i, i)));
    worst = std::max(worst, std::abs(t.change(i, 0)));
  }
  return worst;
}

}  // namespace

bool looksInitialised(const Snapshot& snapshot, int index, double noise) {
  const Cross cross = crossOf(snapshot, index, 3 + 2 * snapshot.featureCount());
  return cross.size > 100.0 * (1e-6 + noise) && cross.off <= 1e-6 + 24.0 * noise;
}

InitialiseCheck checkInitialise(const Transition& t, Sensor sensor,
                                const std::optional<Eigen::Matrix2d>& R) {
  InitialiseCheck check;
  std::vector<FeatureId> bad;
  for (int index = t.shared; index < t.after->featureCount(); ++index) {
    // Against all that stands before it: old features and those new in the same record.
    Outcome one = judgeFeature(t, index, Snapshot::row(index), sensor, R, check);
    if (one.violated()) bad.push_back(t.after->ids[static_cast<std::size_t>(index)]);
    if (!check.outcome.violated() || one.residual > check.outcome.residual) {
      if (check.outcome.kind != Outcome::Kind::checked || one.checked()) check.outcome = one;
    }
  }
  if (check.outcome.kind == Outcome::Kind::not_applicable) return check;
  const double old = changeOfOld(t);
  if (old > 1e-6 + 8.0 * t.noise) {
    check.outcome = Outcome::of(old, 1e-6 + 8.0 * t.noise);
    check.outcome.amount = "an initialisation changes what was in the map before";
  }
  check.outcome.blame.clear();
  for (const FeatureId id : bad) {
    check.outcome.blame.push_back({id, 1.0 / static_cast<double>(bad.size())});
  }
  return check;
}

}  // namespace slamscope::slam
