// SPDX-License-Identifier: MIT
#include "slam/models.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "slam/angle.hpp"

namespace slamscope::slam {
namespace {

Eigen::Matrix2d rotation(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return (Eigen::Matrix2d() << c, -s, s, c).finished();
}

/// J p: p turned by +90°, the derivative of R(θ) p by θ at θ = 0.
Eigen::Vector2d turned(const Eigen::Vector2d& p) {
  return {-p.y(), p.x()};
}

/// sin a / a and (1 − cos a) / a with their derivatives, whole through a = 0.
struct ArcFactors {
  double along, across, d_along, d_across;
};

ArcFactors arcFactors(double a) {
  const double a2 = a * a;
  if (std::abs(a) < 1e-2) {  // the closed forms lose a digit for every digit of a²
    return {1.0 - a2 / 6.0 * (1.0 - a2 / 20.0 * (1.0 - a2 / 42.0)),
            a / 2.0 * (1.0 - a2 / 12.0 * (1.0 - a2 / 30.0)),
            -a / 3.0 * (1.0 - a2 / 10.0 * (1.0 - a2 / 28.0)),
            0.5 * (1.0 - a2 / 4.0 * (1.0 - a2 / 18.0))};
  }
  const double along = std::sin(a) / a;
  const double across = (1.0 - std::cos(a)) / a;
  return {along, across, (std::cos(a) - along) / a, (std::sin(a) - across) / a};
}

[[noreturn]] void throwUnknownSensor() {
  throw std::invalid_argument(
      "an observation model needs sensor range-bearing or relative-position");
}

}  // namespace

Eigen::Vector3d arcIncrement(const Eigen::Vector2d& velocity, double duration, Matrix32d* G_u) {
  const double distance = velocity[0] * duration;
  const double angle = velocity[1] * duration;
  const ArcFactors f = arcFactors(angle);
  if (G_u != nullptr) {
    *G_u << duration * f.along, distance * duration * f.d_along,  //
        duration * f.across, distance * duration * f.d_across,    //
        0.0, duration;
  }
  return {distance * f.along, distance * f.across, angle};
}

Eigen::Vector2d ackermannVelocity(const AckermannGeometry& geometry, const Eigen::Vector2d& control,
                                  Eigen::Matrix2d* J) {
  const double L = geometry.wheelbase;
  if (!(L > 0.0)) {
    throw std::invalid_argument("a car needs a wheelbase above 0 m, got " + std::to_string(L));
  }
  const double h = geometry.encoder_left / L;
  const double tangent = std::tan(control[1]);
  const double d_tangent = 1.0 + tangent * tangent;
  const double share = 1.0 / (1.0 - h * tangent);
  const double forward = control[0] * share;
  if (J != nullptr) {
    const double d_forward = forward * share * h * d_tangent;
    *J << share, d_forward,  //
        share * tangent / L, (d_forward * tangent + forward * d_tangent) / L;
  }
  return {forward, forward * tangent / L};
}

Motion Motion::fromVelocity(double forward, double turn, double duration,
                            const Eigen::Matrix2d& M_control) {
  Motion motion;
  Matrix32d G_u;
  motion.increment = arcIncrement({forward, turn}, duration, &G_u);
  motion.M = G_u * M_control * G_u.transpose();
  motion.control = Eigen::Vector2d(forward, turn);
  return motion;
}

Motion Motion::fromIncrement(const Eigen::Vector3d& increment, const Eigen::Matrix3d& M) {
  return {increment, M, increment};
}

Eigen::Vector3d movePose(const Eigen::Vector3d& pose, const Eigen::Vector3d& increment,
                         Eigen::Matrix3d* F_x, Eigen::Matrix3d* G_u) {
  const Eigen::Matrix2d R_map_body = rotation(pose[2]);
  const Eigen::Vector2d shift = R_map_body * increment.head<2>();
  if (F_x != nullptr) {
    F_x->setIdentity();
    F_x->block<2, 1>(0, 2) = turned(shift);
  }
  if (G_u != nullptr) {
    G_u->setIdentity();
    G_u->topLeftCorner<2, 2>() = R_map_body;
  }
  return {pose[0] + shift[0], pose[1] + shift[1], wrapAngle(pose[2] + increment[2])};
}

Eigen::Vector3d incrementBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Eigen::Vector3d increment;
  increment.head<2>() = rotation(from[2]).transpose() * (to.head<2>() - from.head<2>());
  increment[2] = wrapAngle(to[2] - from[2]);
  return increment;
}

Eigen::Vector2d observeFeature(Sensor sensor, const Eigen::Vector3d& pose,
                               const Eigen::Vector2d& feature) {
  const Eigen::Vector2d d = feature - pose.head<2>();
  switch (sensor) {
    case Sensor::range_bearing:
      return {d.norm(), wrapAngle(std::atan2(d.y(), d.x()) - pose[2])};
    case Sensor::relative_position:
      return rotation(pose[2]).transpose() * d;
    default:
      throwUnknownSensor();
  }
}

ObserveJacobians observeJacobians(Sensor sensor, const Eigen::Vector3d& pose,
                                  const Eigen::Vector2d& feature) {
  const Eigen::Vector2d d = feature - pose.head<2>();
  Eigen::Matrix2d dz_dd;      // z by d
  Eigen::Vector2d dz_dtheta;  // z by heading
  switch (sensor) {
    case Sensor::range_bearing: {
      const double range = d.norm();
      dz_dd.row(0) = d.transpose() / range;
      dz_dd.row(1) = turned(d).transpose() / (range * range);
      dz_dtheta = {0.0, -1.0};
      break;
    }
    case Sensor::relative_position:
      dz_dd = rotation(pose[2]).transpose();
      dz_dtheta = -turned(dz_dd * d);
      break;
    default:
      throwUnknownSensor();
  }
  ObserveJacobians jacobians;
  jacobians.H_v << -dz_dd, dz_dtheta;
  jacobians.H_f = dz_dd;
  return jacobians;
}

Eigen::Vector2d locateFeature(Sensor sensor, const Eigen::Vector3d& pose, const Eigen::Vector2d& z,
                              Matrix23d* G_v, Eigen::Matrix2d* G_z) {
  Eigen::Vector2d d;
  Eigen::Matrix2d dd_dz;
  switch (sensor) {
    case Sensor::range_bearing: {
      const Eigen::Matrix2d R_map_ray = rotation(pose[2] + z[1]);
      d = R_map_ray.col(0) * z[0];
      dd_dz << R_map_ray.col(0), R_map_ray.col(1) * z[0];
      break;
    }
    case Sensor::relative_position:
      dd_dz = rotation(pose[2]);
      d = dd_dz * z;
      break;
    default:
      throwUnknownSensor();
  }
  if (G_v != nullptr) *G_v << Eigen::Matrix2d::Identity(), turned(d);
  if (G_z != nullptr) *G_z = dd_dz;
  return pose.head<2>() + d;
}

Eigen::Vector2d observationDifference(Sensor sensor, const Eigen::Vector2d& z,
                                      const Eigen::Vector2d& z_predicted) {
  Eigen::Vector2d difference = z - z_predicted;
  if (sensor == Sensor::range_bearing) difference[1] = wrapAngle(difference[1]);
  return difference;
}

}  // namespace slamscope::slam
