// SPDX-License-Identifier: MIT
#include "engine/scene/clip.hpp"
#include "engine/scene/cone_outline.hpp"
#include "tests/engine/picture.hpp"

namespace slamscope::engine {
namespace {

constexpr Pinhole kCamera = {
    .width = 640, .height = 480, .fx = 700.0, .fy = 690.0, .cx = 322.7, .cy = 235.2, .skew = 3.0};

/// u = slope · v + offset
struct Edge {
  double slope = 0.0, offset = 0.0;
};

Edge fit(const std::vector<Eigen::Vector2d>& points) {
  Eigen::MatrixXd A(points.size(), 2);
  Eigen::VectorXd b(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    A.row(static_cast<int>(i)) << points[i].y(), 1.0;
    b(static_cast<int>(i)) = points[i].x();
  }
  const Eigen::Vector2d x = A.colPivHouseholderQr().solve(b);
  return {x(0), x(1)};
}

/// The tip as measured in the picture: both edges located row by row from the brightness alone,
/// lines fitted and intersected. Rows from below the rim to a little above the tip.
Eigen::Vector2d measuredTip(const Image& image, const ConeOutline& outline) {
  const double rim_v = outline.rim.max_px.y();
  const double middle_slope = (outline.rim.centre_px.x() - outline.tip_px.x()) /
                              (outline.rim.centre_px.y() - outline.tip_px.y());
  std::vector<Eigen::Vector2d> left, right;
  for (int v = static_cast<int>(rim_v) + 3; v < outline.tip_px.y() - 6; ++v) {
    const int middle =
        static_cast<int>(std::lround(outline.tip_px.x() + middle_slope * (v - outline.tip_px.y())));
    double l = 0.0;
    double r = 0.0;
    for (int u = 0; u < middle; ++u) l += coverage(image, u, v);
    for (int u = middle; u < image.width; ++u) r += coverage(image, u, v);
    left.emplace_back(middle - 0.5 - l, v);
    right.emplace_back(middle - 0.5 + r, v);
  }
  const Edge a = fit(left);
  const Edge b = fit(right);
  const double v = (b.offset - a.offset) / (a.slope - b.slope);
  return {a.slope * v + a.offset, v};
}

class ConePicture : public PictureTest {};

TEST_F(ConePicture, EdgesMeetAtTheProjectedTip) {
  double worst = 0.0;
  for (const double roll : {0.0, 0.3, -0.4}) {
    const View view = lookingAt(kCamera, {0.1, -1.5, 1.0}, {0.0, 0.0, 0.05}, roll);
    for (const Eigen::Vector3d& tip : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.31, 0.2, 0),
                                       Eigen::Vector3d(-0.37, -0.11, 0)}) {
      Scene scene;
      scene.cones = {{tip, 0.2, 0.06, kWhite}};
      const Image picture = draw(view, scene);
      const auto outline = coneOutline(scene.cones[0], view);
      ASSERT_TRUE(outline);
      const Eigen::Vector2d found = measuredTip(picture, *outline);
      const Eigen::Vector2d wanted = project(view.camera, view.T_eye_scene * tip);
      worst = std::max(worst, (found - wanted).norm());

      View shifted = view;  // twin
      shifted.camera.cx += 0.5;
      EXPECT_GT((measuredTip(draw(shifted, scene), *outline) - wanted).norm(), 0.4);
    }
  }
  EXPECT_LE(worst, 0.05);
}

TEST_F(ConePicture, LitOnesHaveTheSameEdgesUpToTheLid) {
  const View view = lookingAt(kCamera, {0.1, -1.5, 0.8}, {0.0, 0.0, 0.05});
  Scene scene;
  scene.cones = {{{0.1, 0.05, 0}, 0.25, 0.06, kWhite}};
  const auto outline = coneOutline(scene.cones[0], view);
  ASSERT_TRUE(outline);
  const Eigen::Vector2d found = measuredTip(draw(view, scene, {}), *outline);
  EXPECT_LE((found - outline->tip_px).norm(), 0.05);
}

/// Area of the hull of tip and rim: the ellipse and the triangle of the two edges, less the
/// segment of the ellipse that both have.
double hullArea(const ConeOutline& outline) {
  const Eigen::Matrix2d to_circle = outline.rim.shape_px2.llt().matrixL().toDenseMatrix().inverse();
  const Eigen::Vector2d p = to_circle * (outline.edge_px[0] - outline.rim.centre_px);
  const Eigen::Vector2d q = to_circle * (outline.edge_px[1] - outline.rim.centre_px);
  const double angle = std::acos(p.normalized().dot(q.normalized()));
  Eigen::Matrix2d sides;
  sides << outline.edge_px[0] - outline.tip_px, outline.edge_px[1] - outline.tip_px;
  const double segment = 0.5 * (angle - std::sin(angle)) / to_circle.determinant();
  return outline.rim.area_px2 + 0.5 * std::abs(sides.determinant()) - segment;
}

TEST_F(ConePicture, AreaIsThatOfTheHullOfTipAndRim) {
  const View view = lookingAt(kCamera, {0.1, -1.5, 1.0}, {0.0, 0.0, 0.05}, 0.2);
  for (const double radius : {0.01, 0.05, 0.12}) {
    Scene scene;
    scene.cones = {{{0.05, 0.1, 0}, 0.2, radius, kWhite}};
    const auto outline = coneOutline(scene.cones[0], view);
    ASSERT_TRUE(outline);
    const double area = momentsOf(draw(view, scene)).area;
    EXPECT_NEAR(area / hullArea(*outline), 1.0, 0.003) << radius;
    EXPECT_GT(std::abs(area / outline->rim.area_px2 - 1.0), 0.003) << "twin: the rim alone";
  }
}

TEST_F(ConePicture, FromStraightAboveItIsTheRimAlone) {
  View view = lookingAt(kCamera, {0.0, -1e-4, 2.0}, {0.0, 0.0, 0.0});
  Scene scene;
  scene.cones = {{{0.01, 0.02, 0}, 0.3, 0.1, kWhite}};
  const Moments drawn = momentsOf(draw(view, scene));
  const double scale = 1.0 / (2.0 - 0.3);
  EXPECT_NEAR(drawn.area, M_PI * 0.01 * kCamera.fx * kCamera.fy * scale * scale, 2.0);
}

TEST_F(ConePicture, EllipsoidsBehindReachItsEdgeWithoutAGap) {
  const View view = lookingAt(kCamera, {0.0, -1.5, 0.5}, {0.0, 0.0, 0.1});
  Scene scene;
  scene.cones = {{{0.0, 0.0, 0.0}, 0.2, 0.05, {1, 0, 0, 1}}};
  scene.ellipsoids = {{{0, 0.4, 0}, 0.35 * Eigen::Matrix3d::Identity(), {1, 1, 0, 1}}};
  const Image picture = draw(view, scene);
  const Eigen::Vector2d tip = project(view.camera, view.T_eye_scene * scene.cones[0].tip);
  for (int v = static_cast<int>(tip.y()) - 60; v < tip.y() + 5; ++v) {
    for (int u = static_cast<int>(tip.x()) - 40; u < tip.x() + 40; ++u) {
      ASSERT_GE(channel(picture, u, v, 0), 253)
          << "the black background shows at " << u << ' ' << v;
    }
  }
}

}  // namespace
}  // namespace slamscope::engine
