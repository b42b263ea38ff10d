// SPDX-License-Identifier: MIT
#include "engine/scene/ellipsoid_outline.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace slamscope::engine {
namespace {

// Of a normalised dual conic [S − c·cᵀ, −c; −cᵀ, −1].
OutlineEllipse ellipseOf(const Eigen::Matrix3d& dual) {
  OutlineEllipse ellipse;
  ellipse.centre_px = -dual.topRightCorner<2, 1>();
  ellipse.shape_px2 =
      dual.topLeftCorner<2, 2>() + ellipse.centre_px * ellipse.centre_px.transpose();
  const Eigen::Vector2d half = ellipse.shape_px2.diagonal().cwiseMax(0.0).cwiseSqrt();
  ellipse.min_px = ellipse.centre_px - half;
  ellipse.max_px = ellipse.centre_px + half;

  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(ellipse.shape_px2);
  const Eigen::Vector2d semi_axes = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  ellipse.semi_minor_px = semi_axes(0);
  ellipse.semi_major_px = semi_axes(1);
  const Eigen::Vector2d major = eigen.eigenvectors().col(1);
  ellipse.angle = std::atan2(major.y(), major.x());
  if (ellipse.angle <= -std::numbers::pi / 2) ellipse.angle += std::numbers::pi;
  if (ellipse.angle > std::numbers::pi / 2) ellipse.angle -= std::numbers::pi;
  ellipse.area_px2 = std::numbers::pi * semi_axes.prod();
  return ellipse;
}

}  // namespace

Eigen::Matrix3d intrinsicMatrix(const Pinhole& camera) {
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  K(0, 0) = camera.fx;
  K(0, 1) = camera.skew;
  K(0, 2) = camera.cx;
  K(1, 1) = camera.fy;
  K(1, 2) = camera.cy;
  return K;
}

Eigen::Matrix3d outlineDualConic(const Pinhole& camera, const Eigen::Vector3d& mu_eye,
                                 const Eigen::Matrix3d& axes_eye) {
  const Eigen::Matrix3d K = intrinsicMatrix(camera);
  const Eigen::Matrix3d cone = axes_eye * axes_eye.transpose() - mu_eye * mu_eye.transpose();
  return K * cone * K.transpose();
}

std::optional<OutlineEllipse> ellipsoidOutline(const Ellipsoid& ellipsoid, const View& view) {
  const Eigen::Vector3d mu_eye = view.T_eye_scene * ellipsoid.centre;
  const Eigen::Matrix3d axes_eye = view.T_eye_scene.linear() * ellipsoid.axes;
  const double nearest = mu_eye.z() - axes_eye.row(2).norm();
  if (!(nearest > 0.0)) return std::nullopt;
  // The principal point is taken out first: the 2×2 block would else be a small difference of large
  // products of pixel coordinates.
  Pinhole centred = view.camera;
  centred.cx = 0.0;
  centred.cy = 0.0;
  const Eigen::Matrix3d C = outlineDualConic(centred, mu_eye, axes_eye);
  OutlineEllipse ellipse = ellipseOf(C / -C(2, 2));
  const Eigen::Vector2d principal(view.camera.cx, view.camera.cy);
  ellipse.centre_px += principal;
  ellipse.min_px += principal;
  ellipse.max_px += principal;
  return ellipse;
}

}  // namespace slamscope::engine
