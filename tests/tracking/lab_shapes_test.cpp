// SPDX-License-Identifier: MIT
#include "tracking/lab_shapes.hpp"

#include <random>

#include "tracking/lab_lens.hpp"
#include "tracking/lab_tag_face.hpp"

namespace slamscope::tracking::lab {
namespace {

Ray down(double x, double y) {
  return {{x, y, 5}, {0, 0, -2}};
}

TEST(LabShapes, RayMeetsTheTopOfACylinder) {
  const Cylinder post{.centre = {1, 2, 0.5}, .radius = 0.2, .half_length = 0.5};
  const Hit hit = intersect(down(1.1, 2.1), post);
  EXPECT_DOUBLE_EQ(hit.t, 2.0);
  EXPECT_EQ(hit.normal, Eigen::Vector3d::UnitZ().eval());
  EXPECT_FALSE(intersect(down(1.15, 2.15), post));
}

TEST(LabShapes, RayMeetsTheFlankOfACylinderAlongAnyAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    const Cylinder cylinder{.centre = {0, 0, 0}, .radius = 0.5, .half_length = 1, .axis = axis};
    Ray ray;
    ray.origin[(axis + 1) % 3] = 3;
    ray.direction = Eigen::Vector3d::Zero();
    ray.direction[(axis + 1) % 3] = -1;
    ray.origin[axis] = 0.9;
    EXPECT_DOUBLE_EQ(intersect(ray, cylinder).t, 2.5) << axis;
    ray.origin[axis] = 1.1;
    EXPECT_FALSE(intersect(ray, cylinder)) << axis;
  }
}

TEST(LabShapes, HitsLieOnTheSurfaceAndFaceTheRay) {
  const Prism box = makeBox({0.1, -0.2}, {0.4, 0.3}, 0.1, 0.6, 0.3, 0.1);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray{{1.5 * uniform(random), 1.5 * uniform(random), 2},
                  {0.5 * uniform(random), 0.5 * uniform(random), -1}};
    const Hit hit = intersect(ray, box);
    if (!hit) continue;
    ++hits;
    const Eigen::Vector3d p = ray.at(hit.t);
    double outside = std::max(p.z() - box.top, box.bottom - p.z());
    for (const Eigen::Vector3d& side : box.sides)
      outside = std::max(outside, side.head<2>().dot(p.head<2>()) - side.z());
    EXPECT_NEAR(outside, 0, 1e-12);
    EXPECT_LT(hit.normal.dot(ray.direction), 0);
  }
  EXPECT_GT(hits, 50);
}

TEST(LabShapes, ABallIsNotHitByRaysThatPass) {
  const Ball ball{{0, 0, 0}, 0.5};
  EXPECT_TRUE(ball.mayBeHit(down(0.49, 0)));
  EXPECT_FALSE(ball.mayBeHit(down(0.51, 0)));
  EXPECT_TRUE(ball.mayBeHit(down(0.51, 0), 0.01));
}

TEST(LabTagFace, HasABlackSquareOfItsSizeInWhite) {
  const TagFace face(3, 0.2);
  const auto ink = [&](double x, double y) { return face.intersect({{x, y, 1}, {0, 0, -1}}).ink; };
  for (const double along : {-0.09, -0.01, 0.05, 0.09}) {
    EXPECT_EQ(ink(along, 0.0999), TagFace::Ink::black);
    EXPECT_EQ(ink(along, 0.1001), TagFace::Ink::white);
    EXPECT_EQ(ink(-0.0999, along), TagFace::Ink::black);
    EXPECT_EQ(ink(-0.1001, along), TagFace::Ink::white);
  }
  EXPECT_FALSE(face.intersect({{0.131, 0, 1}, {0, 0, -1}}));
  EXPECT_FALSE(face.intersect({{0, 0, -1}, {0, 0, 1}})) << "seen from behind";
}

TEST(LabLens, LinearBetweenPixelCornersIsGoodEnough) {
  CameraInfo camera;
  camera.width = 640;
  camera.height = 480;
  camera.K << 320, 0, 322, 0, 320, 238, 0, 0, 1;
  camera.D = {-0.18, 0.04, 0.001, -0.001, -0.004};
  const Lens lens(camera);
  std::vector<Eigen::Vector3d> rays;
  for (int i = 0; i < 400; ++i)
    rays.push_back(lens.direction((i * 37) % 640, (i * 53) % 480, 0.5, 0.5));
  const std::vector<Eigen::Vector2d> pixels = projectByOpenCv(camera, rays);
  double worst = 0;
  for (int i = 0; i < 400; ++i)
    worst = std::max(worst, (pixels[i] - Eigen::Vector2d((i * 37) % 640, (i * 53) % 480)).norm());
  EXPECT_LT(worst, 2e-3);
}

}  // namespace
}  // namespace slamscope::tracking::lab
