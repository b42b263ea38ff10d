// SPDX-License-Identifier: MIT
#include "tracking/head_motion.hpp"

#include <Eigen/Dense>
#include <cmath>

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

/// Covariance that the noise adds in dt seconds, in the axes that the head has then.
Matrix12d noiseOver(double dt, const HeadNoise& noise, const Matrix3d& R_world_head) {
  const double dt2 = dt * dt / 2, dt3 = dt * dt * dt / 3;
  Matrix12d Q = Matrix12d::Zero();
  const Matrix3d I = Matrix3d::Identity(), R_head_world = R_world_head.transpose();
  Q.block<3, 3>(0, 0) = noise.acceleration * dt3 * I;
  Q.block<3, 3>(0, 6) = noise.acceleration * dt2 * R_head_world;
  Q.block<3, 3>(6, 0) = noise.acceleration * dt2 * R_world_head;
  Q.block<3, 3>(6, 6) = noise.acceleration * dt * I;
  Q.block<3, 3>(3, 3) = noise.turning * dt3 * I;
  Q.block<3, 3>(3, 9) = Q.block<3, 3>(9, 3) = noise.turning * dt2 * I;
  Q.block<3, 3>(9, 9) = noise.turning * dt * I;
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

HeadMotion moved(const HeadMotion& from, double dt, Matrix12d* J_to_from) {
  HeadMotion to = from;
  to.time += std::chrono::nanoseconds(std::llround(dt * 1e9));
  const Vector3d turn = from.omega_head * dt;
  const Matrix3d E = rotationExp(turn);
  to.T_world_head.translation() += from.v_world * dt;
  to.T_world_head.linear() =
      Eigen::Quaterniond(from.T_world_head.linear() * E).normalized().toRotationMatrix();
  if (J_to_from) {
    J_to_from->setIdentity();
    J_to_from->block<3, 3>(0, 0) = E.transpose();
    J_to_from->block<3, 3>(0, 6) = dt * to.T_world_head.linear().transpose();
    J_to_from->block<3, 3>(3, 3) = E.transpose();
    J_to_from->block<3, 3>(3, 9) = dt * rightJacobian(turn);
  }
  return to;
}

HeadMotion predicted(const HeadMotion& from, std::chrono::nanoseconds to, const HeadNoise& noise) {
  const double dt = secondsBetween(from.time, to);
  Matrix12d F;
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
  result.omega_head += errors.tail<3>();
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

}  // namespace slamscope::tracking
