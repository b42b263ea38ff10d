// SPDX-License-Identifier: MIT
#include <numbers>

#include "engine/scene/clip.hpp"
#include "tests/engine/picture.hpp"

namespace slamscope::engine {
namespace {

constexpr Pinhole kLineCamera = {
    .width = 400, .height = 300, .fx = 400.0, .fy = 400.0, .cx = 199.5, .cy = 149.5};

/// Looks along +z at the plane z = 1: 1 m is 400 px.
View straightLine() {
  View view;
  view.camera = kLineCamera;
  return view;
}

Eigen::Vector3d at(double u, double v) {
  return {(u - 199.5) / 400.0, (v - 149.5) / 400.0, 1.0};
}

class LinePicture : public PictureTest {};

TEST_F(LinePicture, HasItsWidthInPixelsWhateverTheDepth) {
  for (const double width : {1.0, 2.0, 3.5, 8.0}) {
    for (const double far : {1.0, 4.0}) {
      Scene scene;
      Polyline line{{at(80.3, 70.1), far * at(300.2, 211.7)}, width, kWhite};
      scene.lines = {line};
      const double length = std::hypot(300.2 - 80.3, 211.7 - 70.1);
      const double wanted = width * length + std::numbers::pi * width * width / 4;
      const double area = momentsOf(draw(straightLine(), scene)).area;
      EXPECT_NEAR(area / wanted, 1.0, 0.005) << width;
      EXPECT_GT(std::abs(area / wanted - 1.02), 0.005) << "twin: 2 % wider";
    }
  }
}

TEST_F(LinePicture, TranslucentJointsAreNotDarker) {
  Scene scene;
  const Rgba half = {1, 1, 1, 0.5F};
  scene.lines = {{{at(50, 250), at(150, 60), at(200, 240), at(350, 200)}, 9.0, half}};
  const auto brightest = [](const Image& image) {
    int most = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
      most = std::max<int>(most, image.rgba[i]);
    return most;
  };
  EXPECT_LE(brightest(draw(straightLine(), scene)), 128);
  // Twin: two lines of their own do add up where they cross.
  scene.lines = {{{at(50, 50), at(350, 250)}, 9.0, half}, {{at(50, 250), at(350, 50)}, 9.0, half}};
  EXPECT_GT(brightest(draw(straightLine(), scene)), 128);
}

TEST_F(LinePicture, ALongPathOfTinyStepsLooksLikeTheSameLineInFewSteps) {
  Polyline fine{{}, 4.0, kWhite};
  for (int i = 0; i <= 20000; ++i) fine.points.push_back(at(50 + 300 * i / 20000.0, 100));
  Scene scene;
  scene.lines = {fine};
  const Image many = draw(straightLine(), scene);
  EXPECT_LT(stats_.passes[1].instances, 800);
  scene.lines[0].points = {at(50, 100), at(350, 100)};
  EXPECT_LE(difference(many, draw(straightLine(), scene)).most, 2);
}

TEST_F(LinePicture, ComingFromBehindTheEyeItIsCutNotMirrored) {
  Scene scene;
  // Passes 0.1 m below the eye, from behind, towards a point far ahead.
  scene.lines = {{{{0.0, 0.1, -2.0}, {0.0, 0.1, 50.0}}, 3.0, kWhite}};
  const Moments drawn = momentsOf(draw(straightLine(), scene));
  EXPECT_NEAR(drawn.centre.x(), 199.5, 0.05);
  EXPECT_NEAR(drawn.area, 3.0 * (299.5 - 149.5 - 400.0 * 0.1 / 50.0) + 3.5, 4.0);
  scene.lines = {{{{0.0, 0.1, -2.0}, {0.0, 0.1, -1.0}}, 3.0, kWhite}};
  EXPECT_EQ(draw(straightLine(), scene).rgba[0], 0);
}

TEST_F(LinePicture, LiesBehindGlyphs) {
  Scene scene;
  scene.lines = {{{0.5 * at(50, 150), 0.5 * at(350, 150)}, 5.0, kWhite}};  // nearer, yet behind
  scene.ellipsoids = {{at(200, 150), 0.1 * Eigen::Matrix3d::Identity(), {1, 0, 0, 1}}};
  const Image picture = draw(straightLine(), scene);
  EXPECT_EQ(channel(picture, 200, 150, 1), 0);
  EXPECT_EQ(channel(picture, 100, 150, 1), 255);
}

TEST_F(LinePicture, ArrowsPointAlongTheHeadingFromTheOrigin) {
  const View view =
      lookingAt(kLineCamera, {0.0, -1e-4, 1.0}, {0, 0, 0});  // from above: u = x, v = −y
  Scene scene;
  const double heading = 0.6;
  scene.arrows = {{{0.02, -0.03, 0}, heading, 0.25, 0.08, kWhite}};
  const Image picture = draw(view, scene);
  double farthest = 0.0;
  double nearest = 1e9;
  const Eigen::Vector2d ahead(std::cos(heading), -std::sin(heading));
  const Eigen::Vector2d origin = project(view.camera, view.T_eye_scene * scene.arrows[0].origin);
  for (int v = 0; v < 300; ++v) {
    for (int u = 0; u < 400; ++u) {
      if (coverage(picture, u, v) < 0.5) continue;
      const double along = (Eigen::Vector2d(u, v) - origin).dot(ahead);
      farthest = std::max(farthest, along);
      nearest = std::min(nearest, along);
    }
  }
  EXPECT_NEAR(farthest, 100.0, 1.5);
  EXPECT_NEAR(nearest, 0.0, 1.0);
  EXPECT_GT(momentsOf(picture).area, 800.0);
}

}  // namespace
}  // namespace slamscope::engine
