// SPDX-License-Identifier: MIT
#include <random>

#include "engine/scene/clip.hpp"
#include "engine/scene/ellipsoid_outline.hpp"
#include "tests/engine/picture.hpp"
#include "tests/engine/reference_raycaster.hpp"

namespace slamscope::engine {
namespace {

constexpr Pinhole kSkewed = {
    .width = 640, .height = 480, .fx = 520.0, .fy = 560.0, .cx = 300.3, .cy = 255.6, .skew = 14.0};

View lookingDown() {
  return lookingAt(kSkewed, {0.1, -1.6, 1.4}, {0.05, 0.0, 0.0}, 0.2);
}

Ellipsoid tilted(const Eigen::Vector3d& centre, const Eigen::Vector3d& semi_axes, double angle) {
  const Eigen::Vector3d about = Eigen::Vector3d(0.3, -0.5, 0.8).normalized();
  return {centre, Eigen::AngleAxisd(angle, about).toRotationMatrix() * semi_axes.asDiagonal(),
          kWhite};
}

/// What the closed form leaves: centroid in px, shape relative.
struct Misfit {
  double centroid_px = 0.0;
  double shape = 0.0;
  [[nodiscard]] bool within() const { return centroid_px <= 0.02 && shape <= 0.005; }
};

Misfit misfit(const Moments& drawn, const Ellipsoid& ellipsoid, const View& view) {
  const auto outline = ellipsoidOutline(ellipsoid, view);
  EXPECT_TRUE(outline);
  return {(drawn.centre - outline->centre_px).norm(),
          (drawn.shape - outline->shape_px2).norm() / outline->shape_px2.norm()};
}

class EllipsoidPicture : public PictureTest {
 protected:
  Moments drawnMoments(const Ellipsoid& ellipsoid, const View& view) {
    Scene scene;
    scene.ellipsoids = {ellipsoid};
    return momentsOf(draw(view, scene));
  }
};

TEST_F(EllipsoidPicture, SecondMomentsGiveBackTheExactOutlineForAnyKAndSize) {
  const View view = lookingDown();
  const std::vector<Ellipsoid> ellipsoids = {
      tilted({0.0, 0.0, 0.0}, {0.10, 0.05, 0.03}, 0.4),   // middling
      tilted({-0.6, 0.3, 0.0}, {0.3, 0.2, 0.1}, 1.1),     // large, off the centre
      tilted({0.2, -0.6, 0.4}, {0.25, 0.2, 0.2}, 2.0),    // near: strong perspective
      tilted({0.5, 0.4, 0.1}, {0.03, 0.015, 0.02}, 0.9),  // a few pixels
      tilted({0.0, 0.5, 0.0}, {0.2, 0.2, 0.0}, 0.5),      // disc
      tilted({-0.2, -0.2, 0.0}, {0.3, 0.01, 0.01}, 0.7),  // needle
  };
  for (const Ellipsoid& ellipsoid : ellipsoids) {
    const Misfit found = misfit(drawnMoments(ellipsoid, view), ellipsoid, view);
    EXPECT_LE(found.centroid_px, 0.02) << ellipsoid.centre.transpose();
    EXPECT_LE(found.shape, 0.005) << ellipsoid.centre.transpose();
  }
}

TEST_F(EllipsoidPicture, TwinsThatTheClosedFormMustReject) {
  const View view = lookingDown();
  const Ellipsoid ellipsoid = tilted({-0.3, 0.3, 0.0}, {0.20, 0.12, 0.08}, 0.4);
  const Moments drawn = drawnMoments(ellipsoid, view);
  EXPECT_TRUE(misfit(drawn, ellipsoid, view).within());

  View shifted = view;  // a half-pixel error of K
  shifted.camera.cx += 0.5;
  EXPECT_FALSE(misfit(drawnMoments(ellipsoid, shifted), ellipsoid, view).within());
  View unskewed = view;
  unskewed.camera.skew = 0.0;
  EXPECT_FALSE(misfit(drawnMoments(ellipsoid, unskewed), ellipsoid, view).within());
  Ellipsoid larger = ellipsoid;  // 1 % of the covariance
  larger.axes *= 1.005;
  EXPECT_FALSE(misfit(drawnMoments(larger, view), ellipsoid, view).within());
  // The picture of the centre is not the centre of the picture.
  const Eigen::Vector2d centre_px = project(view.camera, view.T_eye_scene * ellipsoid.centre);
  EXPECT_GT((drawn.centre - centre_px).norm(), 0.05);
}

/// Area of the pixel inside of the outline, by 64 × 64 samples.
double sampledCoverage(const OutlineEllipse& outline, int u, int v) {
  constexpr int kSamples = 64;
  const Eigen::Matrix2d metric = outline.shape_px2.inverse();
  int inside = 0;
  for (int j = 0; j < kSamples; ++j) {
    for (int i = 0; i < kSamples; ++i) {
      const Eigen::Vector2d x =
          Eigen::Vector2d(u + (i + 0.5) / kSamples - 0.5, v + (j + 0.5) / kSamples - 0.5) -
          outline.centre_px;
      inside += x.dot(metric * x) <= 1.0 ? 1 : 0;
    }
  }
  return static_cast<double>(inside) / (kSamples * kSamples);
}

TEST_F(EllipsoidPicture, EdgePixelsAreAsBrightAsTheyAreCovered) {
  Pinhole camera = kSkewed;
  camera.width = 160;
  camera.height = 120;
  camera.cx = 80.3;
  camera.cy = 55.6;
  const View view = lookingAt(camera, {0.0, -1.0, 1.0}, {0.0, 0.0, 0.0});
  for (const Eigen::Vector3d& axes :
       {Eigen::Vector3d(0.1, 0.06, 0.05), Eigen::Vector3d(0.003, 0.002, 0.001),
        Eigen::Vector3d(0.1, 0.001, 0.001)}) {
    const Ellipsoid ellipsoid = tilted({0.01, 0.02, 0.0}, axes, 0.8);
    const auto outline = ellipsoidOutline(ellipsoid, view);
    ASSERT_TRUE(outline);
    Scene scene;
    scene.ellipsoids = {ellipsoid};
    const Image picture = draw(view, scene);
    OutlineEllipse shifted = *outline;
    shifted.centre_px.x() += 0.1;
    double worst = 0.0;
    double worst_twin = 0.0;
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const double drawn = coverage(picture, u, v);
        worst = std::max(worst, std::abs(drawn - sampledCoverage(*outline, u, v)));
        worst_twin = std::max(worst_twin, std::abs(drawn - sampledCoverage(shifted, u, v)));
      }
    }
    EXPECT_LE(worst, 0.03) << axes.transpose();
    EXPECT_GT(worst_twin, 0.03) << axes.transpose();
  }
}

/// Ellipsoids that run through one another, and cones among them.
Scene tangle() {
  Scene scene;
  scene.ellipsoids = {tilted({0.0, 0.0, 0.0}, {0.3, 0.1, 0.1}, 0.3),
                      tilted({0.05, 0.05, 0.02}, {0.1, 0.3, 0.1}, 0.9),
                      tilted({-0.1, 0.0, 0.1}, {0.12, 0.12, 0.3}, 0.2),
                      tilted({0.2, -0.2, 0.0}, {0.2, 0.15, 0.1}, 1.4)};
  scene.cones = {{{0.1, -0.1, -0.05}, 0.4, 0.1, {}}, {{-0.25, 0.05, 0.0}, 0.3, 0.12, {}}};
  const std::array<Rgba, 6> colours = {Rgba{1, 0, 0, 1}, Rgba{0, 1, 0, 1}, Rgba{0, 0, 1, 1},
                                       Rgba{1, 1, 0, 1}, Rgba{0, 1, 1, 1}, Rgba{1, 0, 1, 1}};
  for (std::size_t i = 0; i < 4; ++i) scene.ellipsoids[i].colour = colours[i];
  for (std::size_t i = 0; i < 2; ++i) scene.cones[i].colour = colours[4 + i];
  return scene;
}

/// Pixels away from edges whose colour is not that of what the ray hits first.
int wrongPixels(const Image& drawn, const reference::FinePicture& expected, const Scene& scene) {
  int wrong = 0;
  for (int v = 0; v < drawn.height; ++v) {
    for (int u = 0; u < drawn.width; ++u) {
      if (expected.nearEdge(u, v)) continue;
      const int id = expected.at(u, v).id;
      const auto ellipsoids = static_cast<int>(scene.ellipsoids.size());
      const Rgba colour = id < 0            ? Rgba{0, 0, 0, 1}
                          : id < ellipsoids ? scene.ellipsoids[id].colour
                                            : scene.cones[id - ellipsoids].colour;
      const Rgba found = pixel(drawn, u, v);
      wrong += found.r != colour.r || found.g != colour.g || found.b != colour.b ? 1 : 0;
    }
  }
  return wrong;
}

TEST_F(EllipsoidPicture, WhatIsNearestIsSeenAtEveryPixelWhereGlyphsInterpenetrate) {
  const View view = lookingDown();
  Scene scene = tangle();
  const Image picture = draw(view, scene);
  EXPECT_EQ(wrongPixels(picture, reference::FinePicture(scene, view), scene), 0);
  // Twin: one ellipsoid 5 mm farther away.
  Scene moved = scene;
  moved.ellipsoids[1].centre += 0.005 * Eigen::Vector3d(0, 0.75, -0.66);
  EXPECT_GT(wrongPixels(picture, reference::FinePicture(moved, view), scene), 0);
}

TEST_F(EllipsoidPicture, IsTheSameForGlyphsInAnyOrder) {
  Scene scene;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-0.4, 0.4);
  std::uniform_real_distribution<double> size(0.02, 0.2);
  for (int i = 0; i < 60; ++i) {
    scene.ellipsoids.push_back(tilted({place(random), place(random), 0.2 * place(random)},
                                      {size(random), size(random), size(random)}, place(random)));
    scene.ellipsoids.back().colour = {float(i % 3) / 2, float(i % 4) / 3, 0.5F, 0.6F};
  }
  scene.ellipsoids.push_back(scene.ellipsoids.front());  // concentric, another size
  scene.ellipsoids.back().axes *= 0.5;
  const View view = lookingDown();
  const Image picture = draw(view, scene, {});
  Scene permuted = scene;
  std::ranges::shuffle(permuted.ellipsoids, random);
  EXPECT_TRUE(sameBytes(picture, draw(view, permuted, {})));
  permuted.ellipsoids[5].centre.x() += 0.01;
  EXPECT_FALSE(sameBytes(picture, draw(view, permuted, {})));
}

TEST_F(EllipsoidPicture, ScaledCovarianceIsDrawnWithScaledAxesWhateverItsRoot) {
  const View view = lookingDown();
  const Ellipsoid ellipsoid = tilted({0.1, 0.1, 0.0}, {0.1, 0.06, 0.04}, 0.6);
  const double s = 1.7;
  const Eigen::Matrix3d covariance = ellipsoid.axes * ellipsoid.axes.transpose();
  Scene scaled_axes;
  scaled_axes.ellipsoids = {ellipsoid};
  scaled_axes.ellipsoids[0].axes *= s;
  Scene scaled_covariance;
  scaled_covariance.ellipsoids = {ellipsoid};
  scaled_covariance.ellipsoids[0].axes = (s * s * covariance).eval().llt().matrixL();
  const Image picture = draw(view, scaled_axes);
  const Difference same = difference(picture, draw(view, scaled_covariance));
  EXPECT_LE(same.most, 1);
  scaled_covariance.ellipsoids[0].axes *= 1.002;
  EXPECT_GT(difference(picture, draw(view, scaled_covariance)).most, 1);
}

TEST_F(EllipsoidPicture, MovingWorldAndCameraTogetherChangesNothing) {
  const View view = lookingDown();
  const Scene scene = tangle();
  Eigen::Isometry3d T(Eigen::AngleAxisd(2.1, Eigen::Vector3d::UnitZ()));
  T.translation() = Eigen::Vector3d(4000.0, -7000.0, 12.0);
  View moved_view = view;
  moved_view.T_eye_scene = view.T_eye_scene * T.inverse();
  Scene moved = scene;
  for (Ellipsoid& e : moved.ellipsoids) {
    e.centre = T * e.centre;
    e.axes = T.linear() * e.axes;
  }
  for (Cone& c : moved.cones) c.tip = T * c.tip;
  const Image picture = draw(view, scene, {});
  EXPECT_LE(difference(picture, draw(moved_view, moved, {})).most, 1);
  moved.ellipsoids[0].centre.x() += 0.001;
  EXPECT_GT(difference(picture, draw(moved_view, moved, {})).most, 1);
}

TEST_F(EllipsoidPicture, DegenerateOnesAreDefined) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const View view = lookingDown();
  const Eigen::Vector3d eye = view.T_eye_scene.inverse().translation();
  Scene scene;
  scene.ellipsoids = {
      {{0, 0, 0}, Eigen::Matrix3d::Zero(), kWhite},
      {{nan, 0, 0}, Eigen::Matrix3d::Identity(), kWhite},
      {{0, 0, 0}, Eigen::Matrix3d::Constant(nan), kWhite},
      {eye, 0.5 * Eigen::Matrix3d::Identity(), kWhite},  // around the eye
      {eye + (eye - Eigen::Vector3d(0.05, 0, 0)), Eigen::Matrix3d::Identity(), kWhite},  // behind
  };
  const Image nothing = draw(view, scene);
  EXPECT_EQ(stats_.not_drawn, 2);
  EXPECT_LE(momentsOf(nothing).area, 0.01);

  // Reaches behind the eye beside it: its outline is no ellipse; the ray caster knows.
  scene.ellipsoids = {
      {eye + Eigen::Vector3d(0.0, 0.3, -0.6), Eigen::Vector3d(0.2, 3.0, 0.2).asDiagonal(), kWhite}};
  EXPECT_EQ(wrongPixels(draw(view, scene), reference::FinePicture(scene, view), scene), 0);
}

TEST_F(EllipsoidPicture, AllOfThemAreOneDrawForAllViews) {
  Scene scene;
  for (int i = 0; i < 105; ++i) {
    scene.ellipsoids.push_back(tilted({0.01 * i - 0.5, 0.1, 0.0}, {0.02, 0.01, 0.01}, 0.1 * i));
  }
  const std::array views = {lookingDown(), lookingDown()};
  (void)draw(views, scene, {});
  EXPECT_EQ(stats_.draws("ellipsoids"), 1);
  (void)draw(views.front(), Scene{});
  EXPECT_EQ(stats_.draws("ellipsoids"), 0);
}

}  // namespace
}  // namespace slamscope::engine
