// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/scene/glyphs.hpp"
#include "engine/scene/view.hpp"

namespace slamscope::engine {

/// Filled ellipse of the picture {x : (x − centre)ᵀ shape⁻¹ (x − centre) ≤ 1}, px, OpenCV's
/// convention. The second central moments of its area are shape / 4.
struct OutlineEllipse {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();  ///< not the picture of the 3D centre
  Eigen::Matrix2d shape_px2 = Eigen::Matrix2d::Zero();
  double semi_major_px = 0.0, semi_minor_px = 0.0;
  double angle = 0.0;  ///< rad, of the major axis from +u towards +v, in (−π/2, π/2]
  Eigen::Vector2d min_px = Eigen::Vector2d::Zero(), max_px = Eigen::Vector2d::Zero();  ///< bounds
  double area_px2 = 0.0;  ///< π √det
};

/// Intrinsic matrix K: p_px = K · p_eye / z, with the skew.
[[nodiscard]] Eigen::Matrix3d intrinsicMatrix(const Pinhole& camera);

/// Dual conic C = K (A·Aᵀ − μ·μᵀ) Kᵀ of the outline of the ellipsoid μ + A · unit ball (eye
/// coordinates): a picture line l touches the outline exactly when lᵀ C l = 0. Exact in
/// perspective, A may be singular (a disc). No condition: C is a matrix even for what is behind.
[[nodiscard]] Eigen::Matrix3d outlineDualConic(const Pinhole& camera, const Eigen::Vector3d& mu_eye,
                                               const Eigen::Matrix3d& axes_eye);

/// Exact outline in a view; none where the ellipsoid is not wholly in front of the eye (some point
/// has z ≤ 0), as its picture is then no ellipse.
[[nodiscard]] std::optional<OutlineEllipse> ellipsoidOutline(const Ellipsoid& ellipsoid,
                                                             const View& view);

}  // namespace slamscope::engine
