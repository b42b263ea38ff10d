// SPDX-License-Identifier: MIT
#include "tests/engine/reference_raycaster.hpp"

#include <gtest/gtest.h>

#include "engine/scene/clip.hpp"
#include "engine/scene/cone_outline.hpp"
#include "engine/scene/ellipsoid_outline.hpp"

using namespace slamscope::engine;

namespace {

View smallView() {
  View view;
  view.camera = {
      .width = 200, .height = 150, .fx = 180, .fy = 190, .cx = 97.3, .cy = 78.1, .skew = 3};
  Eigen::Matrix3d R_scene_eye;
  R_scene_eye.col(0) = Eigen::Vector3d(1, 0, 0);
  R_scene_eye.col(2) = Eigen::Vector3d(0, 1, -0.8).normalized();
  R_scene_eye.col(1) = R_scene_eye.col(2).cross(R_scene_eye.col(0));
  view.T_eye_scene.linear() = R_scene_eye.transpose();
  view.T_eye_scene.translation() = -(R_scene_eye.transpose() * Eigen::Vector3d(0.0, -1.0, 0.9));
  return view;
}

struct Blob {
  double area = 0.0;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
};

Blob blobOf(const reference::Picture& picture) {
  Blob blob;
  for (int v = 0; v < picture.height; ++v) {
    for (int u = 0; u < picture.width; ++u) {
      if (picture.at(u, v).id < 0) continue;
      blob.area += 1.0;
      blob.centre += Eigen::Vector2d(u, v);
    }
  }
  blob.centre /= blob.area;
  return blob;
}

}  // namespace

TEST(ReferenceRaycaster, EllipsoidFillsItsExactOutline) {
  Scene scene;
  Ellipsoid e;
  e.centre = {0.1, 0.2, 0.1};
  e.axes << 0.3, 0.1, 0, -0.05, 0.2, 0.02, 0, 0, 0.15;
  scene.ellipsoids = {e};
  const View view = smallView();
  const auto outline = ellipsoidOutline(e, view);
  ASSERT_TRUE(outline);
  const Blob blob = blobOf(reference::raycast(scene, view));
  EXPECT_NEAR(blob.area / outline->area_px2, 1.0, 0.005);
  EXPECT_NEAR((blob.centre - outline->centre_px).norm(), 0.0, 0.05);
  // Twin: the picture of the 3D centre is not the centre of the picture.
  EXPECT_GT((blob.centre - project(view.camera, view.T_eye_scene * e.centre)).norm(), 0.2);
}

TEST(ReferenceRaycaster, ConeFillsTheHullOfTipAndRim) {
  Scene scene;
  scene.cones = {{{0.0, 0.1, 0.0}, 0.4, 0.12, {}}};
  const View view = smallView();
  const auto outline = coneOutline(scene.cones[0], view);
  ASSERT_TRUE(outline);
  const auto picture = reference::raycast(scene, view);
  const auto inTriangle = [&](const Eigen::Vector2d& p) {
    Eigen::Matrix3d corners;
    corners << outline->tip_px, outline->edge_px[0], outline->edge_px[1], 1, 1, 1;
    return (corners.inverse() * p.homogeneous()).minCoeff() >= 0.0;
  };
  int wrong = 0;
  for (int v = 0; v < picture.height; ++v) {
    for (int u = 0; u < picture.width; ++u) {
      const Eigen::Vector2d p(u, v);
      const Eigen::Vector2d d = p - outline->rim.centre_px;
      const bool in_rim = d.dot(outline->rim.shape_px2.inverse() * d) <= 1.0;
      wrong += (in_rim || inTriangle(p)) == (picture.at(u, v).id == 0) ? 0 : 1;
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST(ReferenceRaycaster, TheNearerSolidHidesTheFarther) {
  Scene scene;
  Ellipsoid near_one;
  near_one.centre = {0.0, 0.0, 0.1};
  near_one.axes *= 0.1;
  Ellipsoid far_one = near_one;
  far_one.centre = {0.0, 0.5, 0.1};
  far_one.axes *= 3.0;
  scene.ellipsoids = {far_one, near_one};
  const View view = smallView();
  const Eigen::Vector2d at = project(view.camera, view.T_eye_scene * near_one.centre);
  const auto picture = reference::raycast(scene, view);
  const auto& hit = picture.at(int(std::lround(at.x())), int(std::lround(at.y())));
  EXPECT_EQ(hit.id, 1);
  EXPECT_NEAR(hit.depth, (view.T_eye_scene * near_one.centre).z() - 0.1, 0.02);
}
