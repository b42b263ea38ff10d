// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <sstream>
#include <string>

#include "engine/render/offscreen.hpp"
#include "tests/engine/reference_raycaster.hpp"

// Every pixel of drawn pictures against rays cast on the CPU: which solid is in front.
namespace slamscope::engine {
namespace {

// A flat colour that names the solid; 0 is the background's black.
Rgba colourOf(int id) {
  const int code = id + 1;
  return {float(60 * (code % 4)) / 255.0F, float(60 * (code / 4 % 4)) / 255.0F,
          float(60 * (code / 16 % 4)) / 255.0F, 1.0F};
}

std::array<int, 3> bytesOf(int id) {
  if (id < 0) return {0, 0, 0};
  const int code = id + 1;
  return {60 * (code % 4), 60 * (code / 4 % 4), 60 * (code / 16 % 4)};
}

View viewFrom(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double skew = 0.0) {
  View view;
  view.camera = {
      .width = 200, .height = 150, .fx = 190, .fy = 185, .cx = 97.7, .cy = 76.2, .skew = skew};
  Eigen::Matrix3d R_scene_eye;
  R_scene_eye.col(2) = (target - eye).normalized();
  R_scene_eye.col(0) = R_scene_eye.col(2).cross(Eigen::Vector3d::UnitZ()).normalized();
  R_scene_eye.col(1) = R_scene_eye.col(2).cross(R_scene_eye.col(0));
  view.T_eye_scene.linear() = R_scene_eye.transpose();
  view.T_eye_scene.translation() = -(R_scene_eye.transpose() * eye);
  return view;
}

// Solids that stand before and inside one another.
Scene crowdedScene(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Scene scene;
  for (int i = 0; i < 14; ++i) {
    Ellipsoid e;
    e.centre = Eigen::Vector3d(unit(random), unit(random), 0.2 * unit(random) + 0.2);
    for (int k = 0; k < 9; ++k) e.axes(k) = 0.15 * unit(random);
    e.axes += 0.06 * Eigen::Matrix3d::Identity();
    e.colour = colourOf(int(scene.ellipsoids.size()));
    scene.ellipsoids.push_back(e);
  }
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d tip(unit(random), unit(random), 0.0);
    const double height = 0.3 + 0.01 * i;  // no two lids in one plane: neither would be in front
    scene.cones.push_back({tip, height, 0.1, colourOf(int(scene.ellipsoids.size()) + i)});
  }
  return scene;
}

struct Comparison {
  int compared = 0;  ///< pixels that are not near an edge
  int wrong = 0;
  int covered = 0;    ///< of the compared ones, those that show a solid
  std::string first;  ///< of the wrong ones, for who must look at it
};

Comparison compare(const Image& drawn, const reference::FinePicture& expected) {
  Comparison result;
  for (int v = 0; v < drawn.height; ++v) {
    for (int u = 0; u < drawn.width; ++u) {
      if (expected.nearEdge(u, v)) continue;
      const std::array<int, 3> bytes = bytesOf(expected.at(u, v).id);
      const std::uint8_t* seen = &drawn.rgba[4 * (std::size_t(v) * drawn.width + u)];
      ++result.compared;
      result.covered += expected.at(u, v).id >= 0 ? 1 : 0;
      for (int k = 0; k < 3; ++k) {
        if (std::abs(seen[k] - bytes[k]) > 5) {
          if (++result.wrong > 1) break;
          std::ostringstream text;
          text << '(' << u << ", " << v << ") has " << int(seen[0]) << ' ' << int(seen[1]) << ' '
               << int(seen[2]) << ", not " << bytes[0] << ' ' << bytes[1] << ' ' << bytes[2];
          result.first = text.str();
          break;
        }
      }
    }
  }
  return result;
}

class ReferencePicture : public testing::Test {
 protected:
  Image draw(const View& view, const Scene& scene) {
    return offscreen_.draw({&view, 1}, scene, {.lit = false}).front();
  }

  std::shared_ptr<Gpu> gpu_ = std::make_shared<Gpu>(
      GpuOptions{.device = {}, .validation = true, .instance_extensions = {}});
  Offscreen offscreen_{gpu_, 200, 150};
};

TEST_F(ReferencePicture, NoPixelAwayFromEdgesShowsAnotherSolidThanTheRayHits) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Scene scene = crowdedScene(seed);
    for (const View& view :
         {viewFrom({0.2, -2.6, 1.2}, {0, 0, 0.1}), viewFrom({2.0, 0.5, 2.2}, {0, 0, 0}, 7.0),
          viewFrom({0.0, -1.6, 0.1}, {0, 0, 0.2})}) {
      const Comparison result = compare(draw(view, scene), reference::FinePicture(scene, view));
      EXPECT_EQ(result.wrong, 0) << result.first;
      EXPECT_GT(result.compared, 200 * 150 / 2);
      EXPECT_GT(result.covered, 1000);
    }
  }
  EXPECT_TRUE(gpu_->validationMessages().empty());
}

// Twins: the comparison finds a solid that is out of place by little, and wrong depth order.
TEST_F(ReferencePicture, ASolidThatIsTwoPixelsOffIsFound) {
  const View view = viewFrom({0.2, -2.6, 1.2}, {0, 0, 0.1});
  const Scene scene = crowdedScene(1);
  Scene moved = scene;
  for (Ellipsoid& e : moved.ellipsoids) e.centre.x() += 0.03;
  EXPECT_GT(compare(draw(view, moved), reference::FinePicture(scene, view)).wrong, 20);
}

TEST_F(ReferencePicture, TheNearerSolidIsInFrontWhateverTheOrderOfDrawing) {
  const View view = viewFrom({0.2, -2.6, 1.2}, {0, 0, 0.1});
  const Scene scene = crowdedScene(2);
  Scene turned = scene;
  std::ranges::reverse(turned.ellipsoids);
  std::ranges::reverse(turned.cones);
  const auto expected = reference::FinePicture(scene, view);
  EXPECT_EQ(compare(draw(view, turned), expected).wrong, 0);

  Scene swapped = scene;  // twin: each solid in the colour of the next
  for (std::size_t i = 1; i < scene.ellipsoids.size(); ++i) {
    swapped.ellipsoids[i].colour = scene.ellipsoids[i - 1].colour;
  }
  EXPECT_GT(compare(draw(view, swapped), expected).wrong, 20);
}

}  // namespace
}  // namespace slamscope::engine
