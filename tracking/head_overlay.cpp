// SPDX-License-Identifier: MIT
#include "tracking/head_overlay.hpp"

#include <algorithm>
#include <cmath>

#include "tracking/floor_covariance.hpp"
#include "tracking/tag_scene.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

/// Pixel of a map point in the picture, by the point (map axes), by the head and by time.
struct MapPixelOfHead {
  Eigen::Matrix<double, 2, 3> by_point;
  HeadJacobian by_head;
  Vector2d by_time;  // px/s
};

std::optional<MapPixelOfHead> seenOnMap(const EyeCamera& eye, const HeadMotion& motion,
                                        const MapPlace& map, const Vector3d& p_map) {
  const Vector3d p_world = map.T_world_map * p_map;
  MapPixelOfHead at;
  const auto px = projectRolling(eye, motion, p_world, &at.by_head);
  if (!px) return std::nullopt;
  const CameraInfo& info = eye.model.info();
  const bool inside = px->x() >= -0.5 && px->y() >= -0.5 && px->x() <= info.width - 0.5 &&
                      px->y() <= info.height - 0.5;
  if (!inside) return std::nullopt;
  const HeadMotion then = moved(motion, eye.rowDelay(px->y()));
  const Matrix3d& R_world_head = then.T_world_head.linear();
  const Vector3d p_camera = eye.T_head_camera.inverse() * (then.T_world_head.inverse() * p_world);
  PixelJacobian J;
  if (!eye.model.project(p_camera, &J)) return std::nullopt;
  const PixelJacobian J_head = J * eye.T_head_camera.linear().transpose();
  const Vector3d p_head = eye.T_head_camera * p_camera;
  at.by_point = J_head * R_world_head.transpose() * map.T_world_map.linear();
  at.by_time =
      J_head * (-(R_world_head.transpose() * motion.v_world) - motion.omega_head.cross(p_head));
  return at;
}

Matrix2d covarianceOf(const MapPixelOfHead& at, const EyeCamera& eye, const HeadMotion& motion,
                      const MapPlace& map, const Vector3d& p_map) {
  Eigen::Matrix<double, 2, 3> by_map;  // x, y, yaw in map axes
  by_map << at.by_point.leftCols<2>(), at.by_point * Vector3d::UnitZ().cross(p_map);
  return at.by_head * motion.covariance.topLeftCorner<12, 12>() * at.by_head.transpose() +
         by_map * map.covariance * by_map.transpose() +
         eye.time_sigma * eye.time_sigma * at.by_time * at.by_time.transpose();
}

}  // namespace

EyeCamera::EyeCamera(const Rig& rig, std::size_t camera)
    : model(rig.cameras.at(camera).info),
      T_head_camera(rig.T_head_camera(camera)),
      readout(std::chrono::duration<double>(rig.cameras[camera].readout).count()),
      time_sigma(std::chrono::duration<double>(rig.cameras[camera].time_sigma).count()) {}

std::optional<Vector2d> projectAt(const EyeCamera& eye, const HeadMotion& motion,
                                  const Vector3d& p_world, double delay, HeadJacobian* J) {
  Matrix18d F;
  const bool later = delay != 0;
  const HeadMotion then = later ? moved(motion, delay, J ? &F : nullptr) : motion;
  const Vector3d p_head =
      then.T_world_head.linear().transpose() * (p_world - then.T_world_head.translation());
  const Matrix3d R_camera_head = eye.T_head_camera.linear().transpose();
  PixelJacobian J_uv_p;
  const auto px = eye.model.project(R_camera_head * (p_head - eye.T_head_camera.translation()),
                                    J ? &J_uv_p : nullptr);
  if (!px || !J) return px;
  // A head that moves by (ρ, φ) sees the point move by −ρ − φ × p.
  const PixelJacobian J_head = J_uv_p * R_camera_head;
  Eigen::Matrix<double, 2, 6> by_pose;
  by_pose << -J_head, J_head * skew(p_head);
  if (later) {
    *J = by_pose * F.topLeftCorner<6, 12>();
  } else {
    *J << by_pose, Eigen::Matrix<double, 2, 6>::Zero();
  }
  return px;
}

std::optional<Vector2d> projectRolling(const EyeCamera& eye, const HeadMotion& motion,
                                       const Vector3d& p_world, HeadJacobian* J) {
  constexpr int kMostSteps = 20;
  if (eye.readout == 0) return projectAt(eye, motion, p_world, 0, J);
  double delay = 0;
  for (int i = 0; i < kMostSteps; ++i) {
    const auto px = projectAt(eye, motion, p_world, delay);
    if (!px) return std::nullopt;
    const double row = std::clamp(px->y(), -0.5, eye.model.info().height - 0.5);
    const double next = eye.rowDelay(row);
    const bool at_rest = std::abs(next - delay) * eye.model.info().height < 1e-3 * eye.readout;
    delay = next;
    if (at_rest) break;
  }
  return projectAt(eye, motion, p_world, delay, J);
}

std::optional<Matrix2d> overlayCovariance(const EyeCamera& eye, const HeadMotion& motion,
                                          const MapPlace& map, const Vector3d& p_map) {
  const auto at = seenOnMap(eye, motion, map, p_map);
  if (!at) return std::nullopt;
  return covarianceOf(*at, eye, motion, map, p_map);
}

std::optional<Matrix2d> overlayCovarianceOnFloor(const EyeCamera& eye, const HeadMotion& motion,
                                                 const MapPlace& map, const Vector3d& p_map) {
  const auto at = seenOnMap(eye, motion, map, p_map);
  if (!at) return std::nullopt;
  return floorCovariance(covarianceOf(*at, eye, motion, map, p_map), at->by_point);
}

OverlayError overlayError(const EyeCamera& eye, const HeadMotion& motion, const MapPlace& map,
                          double extent_m) {
  constexpr int kSteps = 7;
  OverlayError sum;
  int count = 0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const Vector3d p(extent_m * (double(i % kSteps) / (kSteps - 1) - 0.5),
                     extent_m * (double(i / kSteps) / (kSteps - 1) - 0.5), 0);
    const auto at = seenOnMap(eye, motion, map, p);
    if (!at) continue;
    const Matrix2d S = covarianceOf(*at, eye, motion, map, p);
    const auto S_floor = floorCovariance(S, at->by_point);
    if (!S_floor) continue;
    sum.px += S.trace();
    sum.floor_m += S_floor->trace();
    ++count;
  }
  if (count == 0) return {};
  return {std::sqrt(sum.px / count), std::sqrt(sum.floor_m / count)};
}

}  // namespace slamscope::tracking
