// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>

namespace slamscope::tracking {

using Vector12d = Eigen::Matrix<double, 12, 1>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;
using Matrix612d = Eigen::Matrix<double, 6, 12>;

/// A head at a moment: where it is and how it moves, with covariance. Errors are coordinates
/// (ρ, φ, δv, δω): T_world_head = mean · (ρ, Exp φ) with ρ (m) and φ (rad) in head axes (right
/// perturbation, translation first), v = mean + δv, ω = mean + δω.
struct HeadMotion {
  std::chrono::nanoseconds time{};
  Eigen::Isometry3d T_world_head = Eigen::Isometry3d::Identity();
  Eigen::Vector3d v_world = Eigen::Vector3d::Zero();     ///< m/s, of the head's origin
  Eigen::Vector3d omega_head = Eigen::Vector3d::Zero();  ///< rad/s, head axes
  Matrix12d covariance = Matrix12d::Zero();
};

/// White noise on the accelerations of a constant-velocity model (Bar-Shalom, Li, Kirubarajan,
/// "Estimation with Applications to Tracking and Navigation", 6.2.2): spectral densities. The
/// defaults suit a person who looks around (3 m/s² and 10 rad/s² that last for 0.2 s).
struct HeadNoise {
  double acceleration = 1.5;  ///< m²/s³
  double turning = 15;        ///< rad²/s³
};

/// Mean `dt` seconds later (or earlier); with J_to_from the derivative of its errors by those of
/// `from`.
[[nodiscard]] HeadMotion moved(const HeadMotion& from, double dt, Matrix12d* J_to_from = nullptr);
/// Mean and covariance at a later time. Earlier times: the mean goes back, the covariance is grown
/// as if it went forward.
[[nodiscard]] HeadMotion predicted(const HeadMotion& from, std::chrono::nanoseconds to,
                                   const HeadNoise& noise);
/// The mean moved by errors; its covariance stays.
[[nodiscard]] HeadMotion corrected(const HeadMotion& motion, const Vector12d& errors);
/// Errors that take `from` to `to` (means).
[[nodiscard]] Vector12d difference(const HeadMotion& from, const HeadMotion& to);

/// Rotation by a vector of angle times axis, and its logarithm.
[[nodiscard]] Eigen::Matrix3d rotationExp(const Eigen::Vector3d& phi);
[[nodiscard]] Eigen::Vector3d rotationLog(const Eigen::Matrix3d& R);

}  // namespace slamscope::tracking
