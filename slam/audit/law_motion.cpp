// SPDX-License-Identifier: MIT
#include "slam/audit/law_motion.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "slam/angle.hpp"
#include "slam/audit/thin_q.hpp"

namespace slamscope::slam {
namespace {

constexpr double kRoundingSafety = 8.0;

Eigen::MatrixXd robotRows(const Snapshot& snapshot, int columns) {
  Eigen::MatrixXd P_vm(3, columns);
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r < 3; ++r) P_vm(r, c) = snapshot.covariance(3 + c, r);
  }
  return P_vm;
}

/// P_vm before and after, columns scaled by the features' σ; rows in their own units.
struct RobotRows {
  Eigen::MatrixXd before, after;
  Eigen::Vector3d row_scale;  ///< 1 / robot's σ after

  [[nodiscard]] double off(const Eigen::Matrix3d& F) const {
    if (before.cols() == 0) return 0.0;
    return (row_scale.asDiagonal() * (after - F * before)).cwiseAbs().maxCoeff();
  }
};

RobotRows robotRowsOf(const Transition& t) {
  RobotRows cross;
  const int columns = 2 * t.shared;
  const Eigen::VectorXd scale = t.scale.tail(columns);
  cross.before = robotRows(*t.before, columns) * scale.asDiagonal();
  cross.after = robotRows(*t.after, columns) * scale.asDiagonal();
  for (int r = 0; r < 3; ++r) {
    const double variance = t.after->covariance(r, r);
    cross.row_scale[r] = variance > 1e-200 ? 1.0 / std::sqrt(variance) : 0.0;
  }
  return cross;
}

struct WrongMotion {
  std::string_view pattern;
  Eigen::Matrix3d F;
};

std::vector<WrongMotion> wrongMotions(const Eigen::Vector2d& d, double turn) {
  const auto with = [](double f13, double f23) {
    Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
    F(0, 2) = f13;
    F(1, 2) = f23;
    return F;
  };
  const Eigen::Vector2d late(std::cos(turn) * d.x() - std::sin(turn) * d.y(),
                             std::sin(turn) * d.x() + std::cos(turn) * d.y());
  return {{"cross-not-propagated", Eigen::Matrix3d::Identity()},
          {"motion-transposed", with(-d.y(), d.x()).transpose()},
          {"motion-sign", with(d.y(), -d.x())},
          {"motion-sign-13", with(d.y(), d.x())},
          {"motion-sign-23", with(-d.y(), -d.x())},
          {"motion-swapped", with(-d.x(), d.y())},
          {"motion-swapped", with(d.x(), -d.y())},
          {"motion-swapped", with(-d.x(), -d.y())},
          {"motion-swapped", with(d.x(), d.y())},
          {"motion-late", with(-late.y(), late.x())}};
}

std::optional<Eigen::Matrix3d> estimated(const RobotRows& cross, double noise) {
  if (cross.before.cols() < 4) return std::nullopt;
  const Eigen::Vector3d length = cross.before.rowwise().norm();
  if (!(length.minCoeff() > 0.0)) return std::nullopt;
  const Eigen::MatrixXd A = (length.cwiseInverse().asDiagonal() * cross.before).transpose();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  if (!(std::abs(qr.matrixR()(2, 2)) > std::max(1e-6, 1e3 * noise))) return std::nullopt;
  const Eigen::Matrix3d R = qr.matrixR().topLeftCorner<3, 3>();
  const Eigen::MatrixXd Q_after = (cross.after * thinQ(qr, 3)).transpose();
  const Eigen::Matrix3d F_transposed =
      qr.colsPermutation() * R.triangularView<Eigen::Upper>().solve(Eigen::Matrix3d(Q_after));
  return Eigen::Matrix3d(F_transposed.transpose() * length.cwiseInverse().asDiagonal());
}

void showEntries(const Eigen::Matrix3d& F, const Eigen::Matrix3d& lawful, Outcome& outcome) {
  const double unit = std::max((lawful - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-12);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      if (std::abs(F(r, c) - lawful(r, c)) < 0.02 * unit) continue;
      outcome.show("F(" + std::to_string(r + 1) + "," + std::to_string(c + 1) + ")", F(r, c),
                   lawful(r, c));
    }
  }
}

bool averagedOverHeading(const Eigen::Matrix3d& F, const Eigen::Vector2d& d) {
  const Eigen::Vector2d used(F(1, 2), -F(0, 2));
  const double along = used.dot(d) / d.squaredNorm();
  const double across = (used - along * d).norm() / d.norm();
  return std::abs(along - 1.0) < 0.1 && across < 0.02;
}

bool firstEstimates(const RobotRows& cross, const Snapshot& after,
                    const LinearisationPoints& points, double tolerance, double lawful_off) {
  if (!points.earlier_prediction && !points.after_prediction) return false;
  const Eigen::Vector3d from =
      points.after_prediction ? points.after_prediction->pose : *points.earlier_prediction;
  const double off = cross.off(lawfulMotionJacobian(after.pose.head<2>() - from.head<2>()));
  return off <= tolerance || off < 0.01 * lawful_off;
}

}  // namespace

Eigen::Matrix3d lawfulMotionJacobian(const Eigen::Vector2d& displacement) {
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 2) = -displacement.y();
  F(1, 2) = displacement.x();
  return F;
}

MotionCheck checkMotion(const Transition& t, const LinearisationPoints& points) {
  MotionCheck check;
  if (t.shared == 0) return check;
  const RobotRows cross = robotRowsOf(t);
  const Eigen::VectorXd change = t.meanChange().head<3>();
  const Eigen::Vector2d d = change.head<2>();
  const Eigen::Matrix3d F = lawfulMotionJacobian(d);
  const double theta = cross.before.row(2).cwiseAbs().maxCoeff();
  const double position_scale = std::max(cross.row_scale[0], cross.row_scale[1]);
  const double rounding = t.noise * (2.0 + d.norm() * t.sigma[2] * position_scale) +
                          2.0 * t.mean_noise * theta * position_scale;
  const double tolerance = kRoundingSafety * rounding + 1e-7;
  const double visible = d.norm() * theta * position_scale;  // what F(1,3), F(2,3) do
  const double off = cross.off(F);
  check.outcome = Outcome::of(off, tolerance);
  if (!check.outcome.violated()) {
    if (visible < 20.0 * tolerance) {
      check.outcome = Outcome::notCheckable("the robot stands, or P_vm is too small to tell");
    }
    return check;
  }
  if (firstEstimates(cross, *t.after, points, tolerance, off)) {
    check.allow = "fej";
    check.outcome = Outcome::notCheckable("F taken at first estimates, as with --allow fej");
    return check;
  }
  for (const WrongMotion& candidate : wrongMotions(d, change[2])) {
    const double candidate_off = cross.off(candidate.F);
    if (candidate_off <= tolerance || candidate_off < 0.01 * off) {
      check.outcome.patterns.push_back(candidate.pattern);
    }
  }
  const std::optional<Eigen::Matrix3d> F_used = estimated(cross, t.noise);
  if (check.outcome.patterns.empty() && off < 0.1 * visible &&
      (!F_used || averagedOverHeading(*F_used, d))) {
    check.nearly = true;
    check.outcome = Outcome::notCheckable("F is the lawful one but for a small factor (UKF?)");
    return check;
  }
  if (F_used) showEntries(*F_used, F, check.outcome);
  check.outcome.amount = "P_vm is not propagated by the Jacobian of the motion";
  return check;
}

}  // namespace slamscope::slam
