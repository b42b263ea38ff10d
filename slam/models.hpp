// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "slam/snapshot.hpp"

namespace slamscope::slam {

using Matrix32d = Eigen::Matrix<double, 3, 2>;
using Matrix23d = Eigen::Matrix<double, 2, 3>;

/// How far the robot moved over one time step: the control input u_v of equation (1), brought to
/// the body frame that the robot had before the step.
struct Motion {
  Eigen::Vector3d increment = Eigen::Vector3d::Zero();  ///< dx, dy (m), dθ (rad)
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();          ///< covariance of `increment`
  Eigen::VectorXd control;                              ///< as it was given, for the record

  /// Differential drive: forward (m/s) and turn (rad/s) held for `duration` (s), integrated exactly
  /// along the arc. `M_control`: covariance of (forward, turn), mapped by the Jacobian.
  [[nodiscard]] static Motion fromVelocity(double forward, double turn, double duration,
                                           const Eigen::Matrix2d& M_control);
  /// Odometry that comes as increments in the body frame, `M` their covariance.
  [[nodiscard]] static Motion fromIncrement(const Eigen::Vector3d& increment,
                                            const Eigen::Matrix3d& M);
};

/// A car that steers with its front wheels. Its pose is that of the middle of the rear axle.
struct AckermannGeometry {
  double wheelbase = 0.0;  ///< m, from axle to axle
  /// m, how far left of the middle the rear wheel runs whose speed is measured; 0: in the middle.
  double encoder_left = 0.0;
};

/// (forward m/s, turn rad/s) of the middle of the rear axle from `control` = (speed m/s of the
/// measured wheel, steering rad, left positive): v = speed / (1 − H/L tan α), ω = v/L tan α
/// (Guivant and Nebot, "Optimization of the simultaneous localization and map-building algorithm
/// for real-time implementation", IEEE TRA 17(3), 2001). Jacobian by the control on request. Throws
/// std::invalid_argument for a wheelbase that is not positive.
[[nodiscard]] Eigen::Vector2d ackermannVelocity(const AckermannGeometry& geometry,
                                                const Eigen::Vector2d& control,
                                                Eigen::Matrix2d* J = nullptr);

/// Body-frame increment of the exact arc driven at `velocity` = (forward m/s, turn rad/s) for
/// `duration` (s). Jacobian by the velocity on request.
[[nodiscard]] Eigen::Vector3d arcIncrement(const Eigen::Vector2d& velocity, double duration,
                                           Matrix32d* G_u = nullptr);

/// f_v of equation (1): `pose` (x, y, θ) moved by a body-frame increment; θ wrapped. Jacobians by
/// the pose (F_x) and by the increment (G_u) on request.
Eigen::Vector3d movePose(const Eigen::Vector3d& pose, const Eigen::Vector3d& increment,
                         Eigen::Matrix3d* F_x = nullptr, Eigen::Matrix3d* G_u = nullptr);

/// The increment that takes pose `from` to pose `to`: movePose(from, result) == to.
[[nodiscard]] Eigen::Vector3d incrementBetween(const Eigen::Vector3d& from,
                                               const Eigen::Vector3d& to);

/// h_i of equation (5): what a sensor at `pose` reads off `feature`. range_bearing: (m, rad);
/// relative_position: (m, m) in the body frame. Throws std::invalid_argument for Sensor::unknown.
[[nodiscard]] Eigen::Vector2d observeFeature(Sensor sensor, const Eigen::Vector3d& pose,
                                             const Eigen::Vector2d& feature);

/// Jacobians of observeFeature() by pose and by feature.
struct ObserveJacobians {
  Matrix23d H_v;
  Eigen::Matrix2d H_f;
};

/// At zero distance the bearing has none (not finite). Throws std::invalid_argument for
/// Sensor::unknown.
[[nodiscard]] ObserveJacobians observeJacobians(Sensor sensor, const Eigen::Vector3d& pose,
                                                const Eigen::Vector2d& feature);

/// Inverse of h_i: where the feature stands that reads `z` from `pose`. Jacobians by pose (G_v) and
/// by reading (G_z) on request. Throws std::invalid_argument for Sensor::unknown.
Eigen::Vector2d locateFeature(Sensor sensor, const Eigen::Vector3d& pose, const Eigen::Vector2d& z,
                              Matrix23d* G_v = nullptr, Eigen::Matrix2d* G_z = nullptr);

/// Equation (7): z − ẑ, a bearing wrapped to (−π, π].
[[nodiscard]] Eigen::Vector2d observationDifference(Sensor sensor, const Eigen::Vector2d& z,
                                                    const Eigen::Vector2d& z_predicted);

}  // namespace slamscope::slam
