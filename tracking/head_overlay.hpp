// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "tracking/camera_model.hpp"
#include "tracking/head_motion.hpp"
#include "tracking/rig.hpp"

namespace slamscope::tracking {

/// One eye's camera, ready to project: the rig's, with its lens model made.
struct EyeCamera {
  CameraModel model;
  Eigen::Isometry3d T_head_camera = Eigen::Isometry3d::Identity();
  double readout = 0;     ///< s
  double time_sigma = 0;  ///< s

  EyeCamera(const Rig& rig, std::size_t camera);
  /// Seconds from the exposure of the middle row to that of a row (px).
  [[nodiscard]] double rowDelay(double row) const {
    return readout * ((row + 0.5) / model.info().height - 0.5);
  }
};

/// Derivative of a pixel by the first twelve errors of HeadMotion, px: α and j move nothing that
/// counts within one picture.
using HeadJacobian = Eigen::Matrix<double, 2, 12>;

/// Pixel of a point of the world that is seen by the head as it is `delay` seconds after
/// `motion.time` (a whole picture, or a row of it). Nothing outside of the lens's valid set.
[[nodiscard]] std::optional<Eigen::Vector2d> projectAt(const EyeCamera& eye,
                                                       const HeadMotion& motion,
                                                       const Eigen::Vector3d& p_world, double delay,
                                                       HeadJacobian* J = nullptr);
/// Pixel of a point of the world in a picture whose middle row is exposed at `motion.time`: with
/// rolling shutter at the time of the row that it falls in (fixed point, to 1e-3 px).
[[nodiscard]] std::optional<Eigen::Vector2d> projectRolling(const EyeCamera& eye,
                                                            const HeadMotion& motion,
                                                            const Eigen::Vector3d& p_world,
                                                            HeadJacobian* J = nullptr);

/// A map in the room: x, y, yaw known with covariance (map axes).
struct MapPlace {
  Eigen::Isometry3d T_world_map = Eigen::Isometry3d::Identity();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Own registration error at a map point (m): Σ_uv = J Σ Jᵀ over head and map, plus (du/dt)² σ_td²
/// of the camera's time, px². Nothing where the point isn't in the picture.
[[nodiscard]] std::optional<Eigen::Matrix2d> overlayCovariance(const EyeCamera& eye,
                                                               const HeadMotion& motion,
                                                               const MapPlace& map,
                                                               const Eigen::Vector3d& p_map);

/// The same as an ellipse on the map's floor that looks like Σ_uv from this eye: covariance of x
/// and y, m², map axes.
[[nodiscard]] std::optional<Eigen::Matrix2d> overlayCovarianceOnFloor(const EyeCamera& eye,
                                                                      const HeadMotion& motion,
                                                                      const MapPlace& map,
                                                                      const Eigen::Vector3d& p_map);

/// Root mean square of that over the floor in view (`extent_m` about the map's origin), in the
/// picture (px) and on the floor (m): what the status line states. Nothing in view: zero.
struct OverlayError {
  double px = 0, floor_m = 0;
};
[[nodiscard]] OverlayError overlayError(const EyeCamera& eye, const HeadMotion& motion,
                                        const MapPlace& map, double extent_m = 3);

}  // namespace slamscope::tracking
