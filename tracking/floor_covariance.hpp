// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>
#include <optional>

#include "tracking/camera_model.hpp"

namespace slamscope::tracking {

/// What looks like S (px²) to a camera, as a covariance of a place on the floor (m²), given how the
/// pixel moves with the point (px_by_point, axes of the floor). Nothing where the floor is seen
/// edge-on.
[[nodiscard]] inline std::optional<Eigen::Matrix2d> floorCovariance(
    const Eigen::Matrix2d& S, const PixelJacobian& px_by_point) {
  const Eigen::Matrix2d floor_by_px = px_by_point.leftCols<2>().inverse();
  if (!floor_by_px.allFinite()) return std::nullopt;
  return floor_by_px * S * floor_by_px.transpose();
}

}  // namespace slamscope::tracking
