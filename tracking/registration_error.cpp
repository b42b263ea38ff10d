// SPDX-License-Identifier: MIT
#include "tracking/registration_error.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "tracking/floor_covariance.hpp"
#include "tracking/tag_scene.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Matrix2d, Eigen::Vector2d, Eigen::Vector3d;

/// Pixel of a map point, by the point (m) and by the perturbation of T_camera_map; in view only.
struct MapPixel {
  PixelJacobian by_point;
  Eigen::Matrix<double, 2, 6> by_pose;
};

std::optional<MapPixel> mapPixel(const CameraModel& camera, const Isometry3d& T_camera_map,
                                 const Vector3d& p_map) {
  PixelJacobian J;
  const auto px = camera.project(T_camera_map * p_map, &J);
  if (!px) return std::nullopt;
  const CameraInfo& info = camera.info();
  const bool inside = px->x() >= -0.5 && px->y() >= -0.5 && px->x() <= info.width - 0.5 &&
                      px->y() <= info.height - 0.5;
  if (!inside) return std::nullopt;
  MapPixel result;
  result.by_point = J * T_camera_map.linear();
  result.by_pose << result.by_point, -result.by_point * skew(p_map);
  return result;
}

}  // namespace

Matrix6d cameraCovariance(const CameraPose& pose) {
  const Vector3d centre = pose.T_camera_world.inverse().translation();
  Matrix6d J = -Matrix6d::Identity();
  J.topRightCorner<3, 3>() = -skew(centre);
  Eigen::Matrix<double, 6, 1> sigma;
  sigma << Vector3d::Constant(pose.sigma_position_m), Vector3d::Constant(pose.sigma_rotation_rad);
  return J * sigma.cwiseAbs2().asDiagonal() * J.transpose();
}

PredictedError predictError(const CameraModel& camera, const RegistrationResult& registration,
                            double extent_m) {
  constexpr int kSteps = 7;
  PredictedError sum;
  int count = 0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const Vector3d p(extent_m * (double(i % kSteps) / (kSteps - 1) - 0.5),
                     extent_m * (double(i / kSteps) / (kSteps - 1) - 0.5), 0);
    const auto at = mapPixel(camera, registration.T_camera_map, p);
    if (!at) continue;
    const Matrix2d S = at->by_pose * registration.covariance * at->by_pose.transpose();
    const auto S_floor = floorCovariance(S, at->by_point);
    if (!S_floor) continue;
    sum.overlay_px += S.trace();
    sum.floor_m += S_floor->trace();
    ++count;
  }
  if (count == 0) return {};
  return {std::sqrt(sum.overlay_px / count), std::sqrt(sum.floor_m / count)};
}

std::optional<PlanarStart> planarStart(const CameraModel& camera, const Isometry3d& T_camera_world,
                                       const RobotTag& robot, const TagDetection& seen) {
  const Isometry3d T_world_camera = T_camera_world.inverse();
  const Vector3d centre = T_world_camera.translation();
  const auto p_tag = tagCorners(robot.size_m);
  Eigen::Matrix<double, 2, 4> world, map;
  for (int i = 0; i < 4; ++i) {
    const Vector3d p_map = robot.T_robot_tag * p_tag[static_cast<std::size_t>(i)];
    const auto ray = camera.unproject(seen.corners_px[static_cast<std::size_t>(i)]);
    if (!ray) return std::nullopt;
    const Vector3d direction = T_world_camera.linear() * *ray;
    const double distance = (p_map.z() - centre.z()) / direction.z();
    if (!(distance > 0) || !std::isfinite(distance)) return std::nullopt;
    map.col(i) = p_map.head<2>();
    world.col(i) = (centre + distance * direction).head<2>();
  }
  const Vector2d map_mean = map.rowwise().mean(), world_mean = world.rowwise().mean();
  map.colwise() -= map_mean;
  world.colwise() -= world_mean;
  const Matrix2d M = world * map.transpose();
  const double cosine = M(0, 0) + M(1, 1), sine = M(1, 0) - M(0, 1);
  PlanarStart start;
  start.scale = std::hypot(cosine, sine) / map.squaredNorm();
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(std::atan2(sine, cosine), Vector3d::UnitZ()).toRotationMatrix();
  start.T_world_map.linear() = R;
  start.T_world_map.translation() << world_mean - R.topLeftCorner<2, 2>() * map_mean, 0;
  return start;
}

std::optional<Matrix2d> overlayCovariance(const CameraModel& camera,
                                          const RegistrationResult& registration,
                                          const Vector3d& p_map) {
  const auto at = mapPixel(camera, registration.T_camera_map, p_map);
  if (!at) return std::nullopt;
  return at->by_pose * registration.covariance * at->by_pose.transpose();
}

std::optional<Matrix2d> overlayCovarianceOnFloor(const CameraModel& camera,
                                                 const RegistrationResult& registration,
                                                 const Vector3d& p_map) {
  const auto at = mapPixel(camera, registration.T_camera_map, p_map);
  if (!at) return std::nullopt;
  return floorCovariance(at->by_pose * registration.covariance * at->by_pose.transpose(),
                         at->by_point);
}

}  // namespace slamscope::tracking
