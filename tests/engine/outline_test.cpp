// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "engine/scene/clip.hpp"
#include "engine/scene/cone_outline.hpp"
#include "engine/scene/ellipsoid_outline.hpp"

using namespace slamscope::engine;

namespace {

// A camera 2 m over the floor that looks down at a slant.
View slantedView(double skew = 0.0) {
  View view;
  view.camera = {
      .width = 1280, .height = 720, .fx = 900, .fy = 880, .cx = 631, .cy = 352, .skew = skew};
  Eigen::Matrix3d R_scene_eye;
  R_scene_eye.col(0) = Eigen::Vector3d(1, 0, 0);
  R_scene_eye.col(2) = Eigen::Vector3d(0, 1, -1).normalized();
  R_scene_eye.col(1) = R_scene_eye.col(2).cross(R_scene_eye.col(0));
  Eigen::Isometry3d T_scene_eye = Eigen::Isometry3d::Identity();
  T_scene_eye.linear() = R_scene_eye;
  T_scene_eye.translation() = Eigen::Vector3d(0.1, -1.6, 2.0);
  view.T_eye_scene = T_scene_eye.inverse();
  return view;
}

std::vector<Ellipsoid> someEllipsoids() {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Ellipsoid> made(20);
  for (Ellipsoid& e : made) {
    e.centre = Eigen::Vector3d(unit(random), unit(random), 0.3 * unit(random));
    for (int i = 0; i < 9; ++i) e.axes(i) = 0.4 * unit(random);
  }
  return made;
}

// Distance of the outline to the projected surface in the direction n: for the exact outline the
// greatest n·p over the surface is n·centre + √(nᵀ S n).
struct Support {
  double outline_px, surface_px;
};

// Surface points by a fine grid over the unit sphere.
std::vector<Eigen::Vector2d> projectedSurface(const Ellipsoid& e, const View& view, int steps) {
  std::vector<Eigen::Vector2d> pixels;
  for (int i = 0; i <= steps; ++i) {
    const double polar = std::numbers::pi * i / steps;
    for (int j = 0; j < 2 * steps; ++j) {
      const double azimuth = std::numbers::pi * j / steps;
      const Eigen::Vector3d direction(std::sin(polar) * std::cos(azimuth),
                                      std::sin(polar) * std::sin(azimuth), std::cos(polar));
      pixels.push_back(project(view.camera, view.T_eye_scene * (e.centre + e.axes * direction)));
    }
  }
  return pixels;
}

std::vector<Support> supports(const Eigen::Vector2d& centre, const Eigen::Matrix2d& shape,
                              const std::vector<Eigen::Vector2d>& surface) {
  std::vector<Support> found;
  for (int k = 0; k < 16; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 16;
    const Eigen::Vector2d n(std::cos(angle), std::sin(angle));
    double most = -1e30;
    for (const Eigen::Vector2d& p : surface) most = std::max(most, n.dot(p));
    found.push_back({n.dot(centre) + std::sqrt(n.dot(shape * n)), most});
  }
  return found;
}

double worstError(const std::vector<Support>& all) {
  double worst = 0.0;
  for (const Support& s : all) worst = std::max(worst, std::abs(s.outline_px - s.surface_px));
  return worst;
}

// What the outline would be if perspective were linear: mean's pixel and J Σ Jᵀ. No oracle.
std::pair<Eigen::Vector2d, Eigen::Matrix2d> linearised(const Ellipsoid& e, const View& view) {
  const Eigen::Vector3d mu = view.T_eye_scene * e.centre;
  const Eigen::Matrix3d axes = view.T_eye_scene.linear() * e.axes;
  Eigen::Matrix<double, 2, 3> J_px_p;
  J_px_p << 1 / mu.z(), 0, -mu.x() / (mu.z() * mu.z()), 0, 1 / mu.z(), -mu.y() / (mu.z() * mu.z());
  J_px_p = intrinsicMatrix(view.camera).topLeftCorner<2, 2>() * J_px_p;
  return {project(view.camera, mu), J_px_p * axes * axes.transpose() * J_px_p.transpose()};
}

}  // namespace

TEST(EllipsoidOutline, TouchesTheProjectedSurfaceInEveryDirection) {
  for (const View& view : {slantedView(), slantedView(40.0)}) {
    for (const Ellipsoid& e : someEllipsoids()) {
      const auto outline = ellipsoidOutline(e, view);
      ASSERT_TRUE(outline);
      const auto surface = projectedSurface(e, view, 160);
      const auto found = supports(outline->centre_px, outline->shape_px2, surface);
      const double grid_px = 4e-4 * outline->semi_major_px;  // the grid misses the very extreme
      EXPECT_LT(worstError(found), grid_px + 1e-6);
      for (const Support& s : found) EXPECT_LE(s.surface_px, s.outline_px + 1e-8);  // all inside
    }
  }
}

TEST(EllipsoidOutline, LinearisedCovarianceIsPixelsOffAndIsRejected) {
  const View view = slantedView();
  double worst = 0.0;
  for (const Ellipsoid& e : someEllipsoids()) {
    const auto [centre, shape] = linearised(e, view);
    worst = std::max(worst, worstError(supports(centre, shape, projectedSurface(e, view, 100))));
  }
  EXPECT_GT(worst, 3.0);
}

TEST(EllipsoidOutline, BoxAxesAndAreaBelongToOneEllipse) {
  for (const Ellipsoid& e : someEllipsoids()) {
    const auto outline = ellipsoidOutline(e, slantedView());
    ASSERT_TRUE(outline);
    const Eigen::Rotation2Dd R(outline->angle);
    const Eigen::Vector2d squares(outline->semi_major_px * outline->semi_major_px,
                                  outline->semi_minor_px * outline->semi_minor_px);
    const Eigen::Matrix2d rebuilt =
        R.toRotationMatrix() * squares.asDiagonal() * R.toRotationMatrix().transpose();
    EXPECT_TRUE(rebuilt.isApprox(outline->shape_px2, 1e-9));
    EXPECT_GE(outline->semi_major_px, outline->semi_minor_px);
    EXPECT_NEAR(outline->area_px2,
                std::numbers::pi * outline->semi_major_px * outline->semi_minor_px, 1e-6);
    const Eigen::Vector2d half = 0.5 * (outline->max_px - outline->min_px);
    EXPECT_TRUE(half.isApprox(outline->shape_px2.diagonal().cwiseSqrt(), 1e-9));
  }
}

TEST(EllipsoidOutline, LinesTouchExactlyWhereTheDualConicVanishes) {
  const View view = slantedView();
  const Ellipsoid e = someEllipsoids().front();
  const auto outline = ellipsoidOutline(e, view);
  ASSERT_TRUE(outline);
  const Eigen::Matrix3d C = outlineDualConic(view.camera, view.T_eye_scene * e.centre,
                                             view.T_eye_scene.linear() * e.axes);
  const auto value = [&C](double u) {
    const Eigen::Vector3d line(1, 0, -u);
    return line.dot(C * line) / C(2, 2);
  };
  EXPECT_NEAR(value(outline->max_px.x()), 0.0, 1e-6);
  EXPECT_NEAR(value(outline->min_px.x()), 0.0, 1e-6);
  EXPECT_GT(std::abs(value(outline->max_px.x() + 1.0)), 1.0);
}

TEST(EllipsoidOutline, IsNoneWhereAnyPointIsNotInFront) {
  View view = slantedView();
  view.T_eye_scene = Eigen::Isometry3d::Identity();
  Ellipsoid e;
  e.centre = {0, 0, 1.0};
  e.axes = Eigen::Vector3d(0.1, 0.1, 0.99).asDiagonal();
  EXPECT_TRUE(ellipsoidOutline(e, view));
  e.axes(2, 2) = 1.01;
  EXPECT_FALSE(ellipsoidOutline(e, view));
  e.centre.z() = -3.0;
  EXPECT_FALSE(ellipsoidOutline(e, view));
}

namespace {

// Signed distance of p from the line a→b, px.
double lineDistance(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  const Eigen::Vector2d d = (b - a).normalized();
  return d.x() * (p.y() - a.y()) - d.y() * (p.x() - a.x());
}

struct EdgeSpread {
  double least_px, most_px;
};

// Where the cone's projected surface lies about one edge; `tilt_px` spoils the edge on purpose.
EdgeSpread spreadAbout(const Cone& cone, const View& view, const ConeOutline& outline, int edge,
                       double tilt_px) {
  const Eigen::Vector2d end = outline.edge_px[edge] + Eigen::Vector2d(tilt_px, tilt_px);
  EdgeSpread spread{1e30, -1e30};
  for (int i = 0; i < 20000; ++i) {
    const double azimuth = 2.0 * std::numbers::pi * i / 20000;
    for (const double along : {0.25, 1.0}) {
      const Eigen::Vector3d p =
          cone.tip + along * Eigen::Vector3d(cone.radius * std::cos(azimuth),
                                             cone.radius * std::sin(azimuth), cone.height);
      const double d =
          lineDistance(outline.tip_px, end, project(view.camera, view.T_eye_scene * p));
      spread.least_px = std::min(spread.least_px, d);
      spread.most_px = std::max(spread.most_px, d);
    }
  }
  return spread;
}

}  // namespace

TEST(ConeOutline, WholeConeLiesOnOneSideOfEachEdgeAndTouchesIt) {
  const View view = slantedView();
  for (const Cone& cone :
       {Cone{{0.3, 0.2, 0.0}, 0.12, 0.03, {}}, Cone{{-0.8, 0.9, 0.1}, 0.3, 0.1, {}}}) {
    const auto outline = coneOutline(cone, view);
    ASSERT_TRUE(outline);
    EXPECT_LT(outline->edge_px[0].x(), outline->edge_px[1].x());
    EXPECT_EQ(outline->tip_px, project(view.camera, view.T_eye_scene * cone.tip));
    for (int edge = 0; edge < 2; ++edge) {
      const EdgeSpread spread = spreadAbout(cone, view, *outline, edge, 0.0);
      // One of the two bounds is the touch, the other is the far side of the cone.
      EXPECT_NEAR(std::min(std::abs(spread.least_px), std::abs(spread.most_px)), 0.0, 1e-5);
      // Twin: an edge that is 0.2 px off cuts the cone or leaves a gap.
      const EdgeSpread off = spreadAbout(cone, view, *outline, edge, 0.2);
      EXPECT_GT(std::min(std::abs(off.least_px), std::abs(off.most_px)), 1e-2);
    }
  }
}

TEST(ConeOutline, IsNoneSeenFromStraightAboveOrBehind) {
  View above = slantedView();
  above.T_eye_scene = Eigen::Isometry3d::Identity();
  above.T_eye_scene.linear() = Eigen::Vector3d(1, -1, -1).asDiagonal();
  above.T_eye_scene.translation() = Eigen::Vector3d(0, 0, 2.0);
  EXPECT_FALSE(coneOutline({{0, 0, 0}, 0.1, 0.03, {}}, above));
  EXPECT_TRUE(coneOutline({{1.5, 0, 0}, 0.1, 0.03, {}}, above));
  EXPECT_FALSE(coneOutline({{1.5, 0, 2.5}, 0.1, 0.03, {}}, above));
}
