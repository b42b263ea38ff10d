// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "apps/lib/view/scene_builder.hpp"
#include "engine/render/offscreen.hpp"
#include "engine/scene/ellipsoid_outline.hpp"
#include "slam/simulation.hpp"

// What the device makes of P, seen in the picture, against slam/correlation in double precision.
namespace slamscope::apps {
namespace {

slam::Snapshot simulatedMap() {
  slam::Simulation simulation({.loops = 1});
  while (simulation.step()) {
  }
  return simulation.filter().snapshot();
}

/// From above the middle of the map; 1 m is 180 px.
engine::View straightDown() {
  engine::View view;
  view.camera = {.width = 900, .height = 900, .fx = 900.0, .fy = 900.0, .cx = 449.5, .cy = 449.5};
  view.T_eye_scene.linear() = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  view.T_eye_scene.translation() = Eigen::Vector3d(-0.4, 0.4, 5.0);
  return view;
}

/// Area, centre and four times the second central moments of what is white.
struct WhiteShape {
  double area = 0.0;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Matrix2d shape = Eigen::Matrix2d::Zero();
};

WhiteShape whiteShape(const engine::Image& image) {
  WhiteShape found;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const std::size_t at = 4 * (std::size_t(v) * std::size_t(image.width) + std::size_t(u));
      const double c = image.rgba[at] / 255.0;
      const Eigen::Vector2d p(u, v);
      found.area += c;
      found.centre += c * p;
      found.shape += c * p * p.transpose();
    }
  }
  found.centre /= found.area;
  found.shape = 4.0 * (found.shape / found.area - found.centre * found.centre.transpose() -
                       Eigen::Matrix2d::Identity() / 12.0);
  return found;
}

class PairOnDevice : public testing::TestWithParam<engine::PairWay> {
 protected:
  /// The pair (i, j) alone, white.
  engine::Image draw(int i, int j) {
    PathTrace path;
    const slam::Clustering clusters;
    const AlarmMarks alarms;
    const engine::Scene built = buildScene({.snapshot = snapshot_,
                                            .points = points_,
                                            .path = path,
                                            .clusters = clusters,
                                            .cluster_pairs = {},
                                            .alarms = alarms},
                                           style_);
    engine::PairGlyphs glyphs = *built.pairs;
    glyphs.colour = {1.0F, 1.0F, 1.0F, 1.0F};
    for (std::uint32_t b = 1; b < snapshot_.ids.size(); ++b) {
      for (std::uint32_t a = 0; a < b; ++a) {
        if (int(a) != i || int(b) != j) glyphs.choice.left_out.emplace_back(a, b);
      }
    }
    engine::Scene scene;
    scene.pairs = std::make_shared<engine::PairGlyphs>(glyphs);
    engine::Image image =
        offscreen_.draw({&view_, 1}, scene, {.lit = false, .pair_way = GetParam()}).front();
    EXPECT_EQ(offscreen_.lastStats().pairs.chosen, 1U);
    return image;
  }

  [[nodiscard]] engine::OutlineEllipse expected(int i, int j) const {
    const auto& f = snapshot_.features;
    const Eigen::Vector2d middle = 0.5 * (f[std::size_t(i)] + f[std::size_t(j)]);
    const auto outline =
        engine::ellipsoidOutline(relativeEllipsoid(slam::relativeCovariance(snapshot_, i, j),
                                                   {middle.x(), middle.y(), 0.0}, style_),
                                 view_);
    EXPECT_TRUE(outline);
    return outline.value_or(engine::OutlineEllipse{});
  }

  slam::Snapshot snapshot_ = simulatedMap();
  engine::PlanarPointsPtr points_ = pointsOf(snapshot_);
  SceneStyle style_{.axis = {.axis = slam::Axis::sigma, .k = 3.0, .gain = 4.0}};
  engine::View view_ = straightDown();
  std::shared_ptr<engine::Gpu> gpu_ = std::make_shared<engine::Gpu>();
  engine::Offscreen offscreen_{gpu_, 900, 900};
};

INSTANTIATE_TEST_SUITE_P(Ways, PairOnDevice,
                         testing::Values(engine::PairWay::quads, engine::PairWay::splats),
                         [](const auto& way) {
                           return way.param == engine::PairWay::quads ? "Quads" : "Splats";
                         });

TEST_P(PairOnDevice, IsTheEllipseOfTheRelativeCovarianceInDouble) {
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{2, 9}, std::pair{4, 14}, std::pair{7, 8}}) {
    const WhiteShape found = whiteShape(draw(i, j));
    const engine::OutlineEllipse outline = expected(i, j);
    EXPECT_LE((found.centre - outline.centre_px).norm(), 0.02) << i << ' ' << j;
    const double size = outline.shape_px2.norm();
    EXPECT_LE((found.shape - outline.shape_px2).norm(), 0.005 * size + 0.05) << i << ' ' << j;
    EXPECT_NEAR(found.area, outline.area_px2, 0.005 * outline.area_px2 + 0.1) << i << ' ' << j;
    // Twin: the covariance of another pair.
    const engine::OutlineEllipse other = expected(i == 0 ? 2 : 0, j == 14 ? 11 : 13);
    EXPECT_GT((found.shape - other.shape_px2).norm(), 0.005 * size + 0.05) << i << ' ' << j;
  }
}

TEST_P(PairOnDevice, HasTheLengthsOfEveryAxisLaw) {
  for (const slam::AxisScale& axis :
       {slam::AxisScale{.axis = slam::Axis::eigenvalue, .gain = 400.0},
        slam::AxisScale{.axis = slam::Axis::log, .gain = 0.8}}) {
    style_.axis = axis;
    const WhiteShape found = whiteShape(draw(2, 9));
    const engine::OutlineEllipse outline = expected(2, 9);
    EXPECT_NEAR(found.area, outline.area_px2, 0.005 * outline.area_px2 + 0.1);
    style_.axis.gain *= 1.01;
    EXPECT_GT(std::abs(found.area - expected(2, 9).area_px2), 0.005 * outline.area_px2 + 0.1);
  }
}

}  // namespace
}  // namespace slamscope::apps
