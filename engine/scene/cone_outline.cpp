// SPDX-License-Identifier: MIT
#include "engine/scene/cone_outline.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <utility>

#include "engine/scene/clip.hpp"

namespace slamscope::engine {

std::optional<ConeOutline> coneOutline(const Cone& cone, const View& view) {
  const Eigen::Vector3d tip_eye = view.T_eye_scene * cone.tip;
  if (!(tip_eye.z() > 0.0)) return std::nullopt;
  // The rim is a flat ellipsoid.
  Ellipsoid disc;
  disc.centre = cone.tip + Eigen::Vector3d(0.0, 0.0, cone.height);
  disc.axes = Eigen::Vector3d(cone.radius, cone.radius, 0.0).asDiagonal();
  const auto rim = ellipsoidOutline(disc, view);
  if (!rim) return std::nullopt;

  ConeOutline outline;
  outline.rim = *rim;
  outline.tip_px = project(view.camera, tip_eye);
  // In coordinates in which the rim is the unit circle, the tangents from a point q touch it where
  // x·q = 1.
  const Eigen::Matrix2d L = rim->shape_px2.llt().matrixL();
  const Eigen::Vector2d q = L.inverse() * (outline.tip_px - rim->centre_px);
  const double distance2 = q.squaredNorm();
  if (!(distance2 > 1.0)) return std::nullopt;
  const Eigen::Vector2d across(-q.y(), q.x());
  const double along = 1.0 / distance2;
  const double aside = std::sqrt(distance2 - 1.0) / distance2;
  outline.edge_px[0] = rim->centre_px + L * (along * q + aside * across);
  outline.edge_px[1] = rim->centre_px + L * (along * q - aside * across);
  if (outline.edge_px[1].x() < outline.edge_px[0].x()) {
    std::swap(outline.edge_px[0], outline.edge_px[1]);
  }
  return outline;
}

}  // namespace slamscope::engine
