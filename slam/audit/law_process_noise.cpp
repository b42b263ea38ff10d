// SPDX-License-Identifier: MIT
#include "slam/audit/law_process_noise.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "slam/audit/law_motion.hpp"
#include "slam/correlation.hpp"

namespace slamscope::slam {
namespace {

Eigen::Matrix3d turned(const Eigen::Matrix3d& Q, double heading) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(heading).toRotationMatrix();
  return R * Q * R.transpose();
}

Outcome declared(const Eigen::Matrix3d& Q, const Eigen::Matrix3d& Q_lawful,
                 const Eigen::Vector3d& scale, double tolerance) {
  const Eigen::Matrix3d off = scale.asDiagonal() * (Q - Q_lawful) * scale.asDiagonal();
  const double size = (scale.asDiagonal() * Q_lawful * scale.asDiagonal()).cwiseAbs().maxCoeff();
  Outcome outcome = Outcome::of(off.cwiseAbs().maxCoeff(), tolerance + 1e-5 * size);
  if (!outcome.violated()) return outcome;
  Eigen::Index r = 0;
  Eigen::Index c = 0;
  off.cwiseAbs().maxCoeff(&r, &c);
  outcome.show("Q(" + std::to_string(r + 1) + "," + std::to_string(c + 1) + ")", Q(r, c),
               Q_lawful(r, c));
  outcome.amount = "the process noise is not the declared one";
  return outcome;
}

}  // namespace

Eigen::Matrix3d processNoiseOf(const Transition& t) {
  const Eigen::Matrix3d F =
      lawfulMotionJacobian(t.after->pose.head<2>() - t.before->pose.head<2>());
  return t.after->poseCovariance() - F * t.before->poseCovariance() * F.transpose();
}

Outcome checkProcessNoise(const Transition& t, const std::optional<Eigen::Matrix3d>& body_Q,
                          bool motion_whole) {
  const Eigen::Matrix3d Q = processNoiseOf(t);
  Eigen::Vector3d scale;
  for (int r = 0; r < 3; ++r) {
    const double variance = std::max(t.after->covariance(r, r), t.before->covariance(r, r));
    scale[r] = variance > 1e-200 ? 1.0 / std::sqrt(variance) : 0.0;
  }
  const Eigen::Matrix3d Q_scaled = scale.asDiagonal() * Q * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(Q_scaled),
                                                             Eigen::EigenvaluesOnly);
  const Eigen::Vector2d d = t.after->pose.head<2>() - t.before->pose.head<2>();
  const double spread = 1.0 + d.norm() * t.sigma[2] * std::max(scale[0], scale[1]);
  const double tolerance = 1e-7 + 12.0 * t.noise * spread * spread +
                           4.0 * t.mean_noise * t.sigma[2] * std::max(scale[0], scale[1]) * spread;
  Outcome outcome = Outcome::of(std::max(0.0, -eigen.eigenvalues()[0]), tolerance);
  if (tolerance > 0.05) return Outcome::notCheckable("Q drowns in the log's rounding");
  if (outcome.violated()) {
    if (!motion_whole && outcome.residual < 0.02) {
      return Outcome::notCheckable("F of the filter is not known well enough");
    }
    outcome.amount = "a prediction takes uncertainty away: P_vv - F P_vv F^T is negative";
    const std::string what = "least eigenvalue of P_vv - F P_vv F^T, scaled";
    outcome.show(what, eigen.eigenvalues()[0], 0.0, LawfulIs::at_least);
    return outcome;
  }
  if (!motion_whole) return outcome;
  if (t.after->Q) {
    outcome = declared(Q, *t.after->Q, scale, tolerance);
    const Eigen::Matrix3d in_body = turned(*t.after->Q, -t.before->pose[2]);
    if (outcome.violated() && !declared(Q, in_body, scale, tolerance).violated()) {
      outcome.patterns.emplace_back("noise-unrotated");
    }
    return outcome;
  }
  if (body_Q && !Q.isZero(0.0)) {
    outcome = declared(Q, turned(*body_Q, t.before->pose[2]), scale, tolerance);
    if (outcome.violated() && !declared(Q, *body_Q, scale, tolerance).violated()) {
      outcome.patterns.emplace_back("noise-unrotated");
    }
  }
  return outcome;
}

void UnrotatedNoise::take(const Eigen::Matrix3d& Q, double heading) {
  const PrincipalAxes axes = principalAxes(Q.topLeftCorner<2, 2>());
  if (!(axes.eigenvalues[0] > 1.5 * axes.eigenvalues[1]) || !(axes.eigenvalues[0] > 0.0)) return;
  const auto doubled = [](double angle) {
    return Eigen::Vector2d(std::cos(2.0 * angle), std::sin(2.0 * angle));
  };
  ++count_;
  in_map_ += doubled(axes.angle);
  in_body_ += doubled(axes.angle - heading);
  headings_ += doubled(heading);
}

bool UnrotatedNoise::found() const {
  if (count_ < 50) return false;
  const double n = count_;
  return headings_.norm() < 0.8 * n && in_map_.norm() > 0.98 * n && in_body_.norm() < 0.9 * n;
}

}  // namespace slamscope::slam
