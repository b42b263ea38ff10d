// SPDX-License-Identifier: MIT
#include "tracking/head_motion.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "tracking/symmetric_solve.hpp"
#include "tracking/tag_scene.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

double secondsBetween(std::chrono::nanoseconds from, std::chrono::nanoseconds to) {
  return std::chrono::duration<double>(to - from).count();
}

/// How exp(φ + δ) = exp(φ) exp(J δ): right Jacobian of SO(3).
Matrix3d rightJacobian(const Vector3d& phi) {
  const double angle = phi.norm();
  const Matrix3d S = skew(phi);
  if (angle < 1e-6) return Matrix3d::Identity() - 0.5 * S;
  const double a2 = angle * angle;
  return Matrix3d::Identity() - (1 - std::cos(angle)) / a2 * S +
         (angle - std::sin(angle)) / (a2 * angle) * S * S;
}

constexpr int kTurning[] = {3, 9, 12, 15};  // where φ, δω, δα, δj begin

/// Covariance that the noise adds in dt seconds, in the axes that the head has then.
Matrix18d noiseOver(double dt, const HeadNoise& noise, const Matrix3d& R_world_head) {
  const double dt2 = dt * dt / 2, dt3 = dt * dt * dt / 3;
  Matrix18d Q = Matrix18d::Zero();
  const Matrix3d I = Matrix3d::Identity(), R_head_world = R_world_head.transpose();
  Q.block<3, 3>(0, 0) = noise.acceleration * dt3 * I;
  Q.block<3, 3>(0, 6) = noise.acceleration * dt2 * R_head_world;
  Q.block<3, 3>(6, 0) = noise.acceleration * dt2 * R_world_head;
  Q.block<3, 3>(6, 6) = noise.acceleration * dt * I;
  // White noise integrated 4, 3, 2, 1 times: E[xₘ xₙ] = dt^(m+n−1) / ((m+n−1) (m−1)! (n−1)!).
  constexpr double kFactorial[] = {6, 2, 1, 1};
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k) {
      const int power = 7 - i - k;
      Q.block<3, 3>(kTurning[i], kTurning[k]) =
          noise.snap * std::pow(dt, power) / (power * kFactorial[i] * kFactorial[k]) * I;
    }
  }
  return Q;
}

}  // namespace

Matrix3d rotationExp(const Vector3d& phi) {
  const double angle = phi.norm();
  if (angle < 1e-12) return Matrix3d::Identity() + skew(phi);
  return Eigen::AngleAxisd(angle, phi / angle).toRotationMatrix();
}

Vector3d rotationLog(const Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

HeadMotion moved(const HeadMotion& from, double dt, Matrix18d* J_to_from) {
  HeadMotion to = from;
  to.time += std::chrono::nanoseconds(std::llround(dt * 1e9));
  const double dt2 = dt * dt / 2, dt3 = dt * dt * dt / 6;
  const Vector3d turn = from.omega_head * dt + from.alpha_head * dt2 + from.jerk_head * dt3;
  const Matrix3d E = rotationExp(turn);
  to.T_world_head.translation() += from.v_world * dt;
  to.T_world_head.linear() =
      Eigen::Quaterniond(from.T_world_head.linear() * E).normalized().toRotationMatrix();
  to.omega_head += from.alpha_head * dt + from.jerk_head * dt2;
  to.alpha_head += from.jerk_head * dt;
  if (J_to_from) {
    const Matrix3d I = Matrix3d::Identity(), by_turn = rightJacobian(turn);
    J_to_from->setIdentity();
    J_to_from->block<3, 3>(0, 0) = E.transpose();
    J_to_from->block<3, 3>(0, 6) = dt * to.T_world_head.linear().transpose();
    J_to_from->block<3, 3>(3, 3) = E.transpose();
    J_to_from->block<3, 3>(3, 9) = dt * by_turn;
    J_to_from->block<3, 3>(3, 12) = dt2 * by_turn;
    J_to_from->block<3, 3>(3, 15) = dt3 * by_turn;
    J_to_from->block<3, 3>(9, 12) = J_to_from->block<3, 3>(12, 15) = dt * I;
    J_to_from->block<3, 3>(9, 15) = dt2 * I;
  }
  return to;
}

HeadMotion predicted(const HeadMotion& from, std::chrono::nanoseconds to, const HeadNoise& noise) {
  const double dt = secondsBetween(from.time, to);
  Matrix18d F;
  HeadMotion result = moved(from, dt, &F);
  result.time = to;
  result.covariance = F * from.covariance * F.transpose() +
                      noiseOver(std::abs(dt), noise, result.T_world_head.linear());
  return result;
}

HeadMotion corrected(const HeadMotion& motion, const Vector12d& errors) {
  HeadMotion result = motion;
  const Matrix3d& R = motion.T_world_head.linear();
  result.T_world_head.translation() += R * errors.head<3>();
  result.T_world_head.linear() =
      Eigen::Quaterniond(R * rotationExp(errors.segment<3>(3))).normalized().toRotationMatrix();
  result.v_world += errors.segment<3>(6);
  result.omega_head += errors.segment<3>(9);
  return result;
}

Vector12d difference(const HeadMotion& from, const HeadMotion& to) {
  const Matrix3d R_from_world = from.T_world_head.linear().transpose();
  Vector12d errors;
  errors << R_from_world * (to.T_world_head.translation() - from.T_world_head.translation()),
      rotationLog(R_from_world * to.T_world_head.linear()), to.v_world - from.v_world,
      to.omega_head - from.omega_head;
  return errors;
}

HeadMotion conditioned(const HeadMotion& prior, const HeadMotion& mean, const Matrix12d& P) {
  const Matrix12d P_seen = prior.covariance.topLeftCorner<12, 12>();
  const Eigen::Matrix<double, 12, 6> P_seen_rest = prior.covariance.topRightCorner<12, 6>();
  const Eigen::Matrix<double, 6, 12> G = solveSymmetric(P_seen, P_seen_rest).transpose();
  const Eigen::Matrix<double, 6, 1> rest = G * difference(prior, mean);
  HeadMotion result = mean;
  result.alpha_head = prior.alpha_head + rest.head<3>();
  result.jerk_head = prior.jerk_head + rest.tail<3>();
  result.covariance.topLeftCorner<12, 12>() = P;
  result.covariance.bottomLeftCorner<6, 12>() = G * P;
  result.covariance.topRightCorner<12, 6>() = (G * P).transpose();
  result.covariance.bottomRightCorner<6, 6>() =
      prior.covariance.bottomRightCorner<6, 6>() - G * (P_seen - P) * G.transpose();
  return result;
}

}  // namespace slamscope::tracking
