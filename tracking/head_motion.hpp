// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>

namespace slamscope::tracking {

using Vector12d = Eigen::Matrix<double, 12, 1>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;
using Matrix18d = Eigen::Matrix<double, 18, 18>;

/// A head at a moment: where it is and how it moves, with covariance. Errors are coordinates
/// (ρ, φ, δv, δω, δα, δj): T_world_head = mean · (ρ, Exp φ) with ρ (m) and φ (rad) in head axes
/// (right perturbation, translation first), v = mean + δv, ω = mean + δω, and so on. The first
/// twelve are what a picture tells of; of α and j it knows by them alone.
struct HeadMotion {
  std::chrono::nanoseconds time{};
  Eigen::Isometry3d T_world_head = Eigen::Isometry3d::Identity();
  Eigen::Vector3d v_world = Eigen::Vector3d::Zero();     ///< m/s, of the head's origin
  Eigen::Vector3d omega_head = Eigen::Vector3d::Zero();  ///< rad/s, head axes
  Eigen::Vector3d alpha_head = Eigen::Vector3d::Zero();  ///< change of omega_head, rad/s²
  Eigen::Vector3d jerk_head = Eigen::Vector3d::Zero();   ///< change of alpha_head, rad/s³
  Matrix18d covariance = Matrix18d::Zero();
};

/// White noise that moves a head: on the acceleration of its place, on the change of the jerk of
/// its turning (Bar-Shalom, Li, Kirubarajan, "Estimation with Applications to Tracking and
/// Navigation", 6.2; Mehrotra and Mahapatra, "A Jerk Model for Tracking Highly Maneuvering
/// Targets", IEEE AES 33(4), 1997). Spectral densities. Turning takes two orders more because a
/// neck starts and stops within some frames: after 0.1 s without tags constant velocity is 7 times
/// further off in a turn of 60°/s. The defaults suit a person who looks around (3 m/s² that last
/// for 0.2 s; turns of 120°/s to and fro).
struct HeadNoise {
  double acceleration = 1.5;  ///< m²/s³
  double snap = 1000;         ///< of the turning, rad²/s⁷
};

/// Mean `dt` seconds later (or earlier); with J_to_from the derivative of its errors by those of
/// `from`.
[[nodiscard]] HeadMotion moved(const HeadMotion& from, double dt, Matrix18d* J_to_from = nullptr);
/// Mean and covariance at a later time. Earlier times: the mean goes back, the covariance is grown
/// as if it went forward.
[[nodiscard]] HeadMotion predicted(const HeadMotion& from, std::chrono::nanoseconds to,
                                   const HeadNoise& noise);
/// The mean moved by the first twelve errors; its covariance stays.
[[nodiscard]] HeadMotion corrected(const HeadMotion& motion, const Vector12d& errors);
/// The first twelve errors that take `from` to `to` (means).
[[nodiscard]] Vector12d difference(const HeadMotion& from, const HeadMotion& to);

/// `prior` once its first twelve numbers are known to be those of `mean` with covariance `P`: α and
/// j follow by their correlation with them (the update of a Kalman filter that does not measure
/// them).
[[nodiscard]] HeadMotion conditioned(const HeadMotion& prior, const HeadMotion& mean,
                                     const Matrix12d& P);

/// Rotation by a vector of angle times axis, and its logarithm.
[[nodiscard]] Eigen::Matrix3d rotationExp(const Eigen::Vector3d& phi);
[[nodiscard]] Eigen::Vector3d rotationLog(const Eigen::Matrix3d& R);

}  // namespace slamscope::tracking
