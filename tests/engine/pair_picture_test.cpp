// SPDX-License-Identifier: MIT
#include "engine/scene/clip.hpp"
#include "engine/scene/ellipsoid_outline.hpp"
#include "engine/scene/pair_ellipsoid.hpp"
#include "tests/engine/pair_scene.hpp"

// Pairs of points as ellipsoids, pixel by pixel, in both ways of drawing.
namespace slamscope::engine {
namespace {

INSTANTIATE_TEST_SUITE_P(Ways, PairPicture, ::testing::Values(PairWay::quads, PairWay::splats),
                         [](const auto& way) {
                           return way.param == PairWay::quads ? "Quads" : "Splats";
                         });

struct PairMisfit {
  double centroid_px = 0.0, shape = 0.0, area = 0.0;
};

PairMisfit pairMisfit(const Image& image, const Ellipsoid& ellipsoid, const View& view) {
  const Moments drawn = momentsOf(image);
  const auto outline = ellipsoidOutline(ellipsoid, view);
  if (!outline) return {1e9, 1e9, 1e9};
  return {(drawn.centre - outline->centre_px).norm(),
          (drawn.shape - outline->shape_px2).norm() / outline->shape_px2.norm(),
          std::abs(drawn.area - outline->area_px2) / outline->area_px2};
}

TEST_P(PairPicture, SecondMomentsGiveBackTheCovarianceOfTheDifference) {
  const View view = overFloor();
  struct Case {
    double major, minor, angle;
    Eigen::Vector2d middle;
  };
  for (const Case& c : {Case{0.2, 0.08, 0.4, {0.0, 0.0}}, Case{0.05, 0.05, 0.0, {0.2, 0.3}},
                        Case{0.3, 0.02, 2.2, {-0.1, 0.1}}, Case{0.03, 0.025, -1.1, {-0.5, 0.4}},
                        Case{0.4, 0.3, 1.0, {0.1, -0.1}}}) {
    const Image image =
        drawn(view, sceneOf(pairWith(covarianceOf(c.major, c.minor, c.angle), c.middle)));
    const PairMisfit found =
        pairMisfit(image, ellipsoidOf(c.major, c.minor, c.angle, c.middle), view);
    EXPECT_LE(found.centroid_px, 0.02) << c.major;
    EXPECT_LE(found.shape, 0.005) << c.major;
    EXPECT_LE(found.area, 0.005) << c.major;
    // Twins: a hundredth more of the covariance, two degrees more.
    const PairMisfit larger =
        pairMisfit(image, ellipsoidOf(1.005 * c.major, 1.005 * c.minor, c.angle, c.middle), view);
    EXPECT_GT(larger.area, 0.005) << c.major;
    if (c.major == c.minor) continue;
    const PairMisfit turned =
        pairMisfit(image, ellipsoidOf(c.major, c.minor, c.angle + 0.035, c.middle), view);
    EXPECT_GT(turned.shape, 0.005) << c.major;
  }
}

TEST_P(PairPicture, FromAThirdOfAPixelToTheWholePictureTheAreaIsRight) {
  const View view = overFloor();
  const double px = 2.1 / 300.0;  // m, at the middle of the picture
  for (const double size : {0.3, 1.0, 4.0, 40.0, 110.0}) {
    const double radius = 0.5 * size * px;
    const Image image =
        drawn(view, sceneOf(pairWith(covarianceOf(radius, radius, 0.0), {0.05, 0.0})));
    const auto outline = ellipsoidOutline(ellipsoidOf(radius, radius, 0.0, {0.05, 0.0}), view);
    ASSERT_TRUE(outline);
    // An edge pixel is right to 0.03 of a pixel.
    const double allowed = std::max(0.005, 0.025 / outline->area_px2);
    EXPECT_NEAR(momentsOf(image).area / outline->area_px2, 1.0, allowed) << size;
    EXPECT_GT(std::abs(momentsOf(image).area / (1.5 * outline->area_px2) - 1.0), allowed) << size;
  }
}

TEST_P(PairPicture, EveryPixelAwayFromEdgesIsThatOfTheNearestEllipsoid) {
  const View view = overFloor();
  PairGlyphs glyphs = someMap(8, 0.08);
  glyphs.colour = {1.0F, 0.0F, 0.0F, 1.0F};
  Scene scene = sceneOf(glyphs);
  const Image pairs = drawn(view, scene);
  EXPECT_EQ(stats_.pairs.chosen, 28U);
  // The same as ellipsoids of the scene, made in double precision.
  Scene expected;
  const auto& means = glyphs.points->means();
  for (std::size_t j = 1; j < means.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const auto& blocks = glyphs.points->blocks();
      const auto block = [&](std::size_t a, std::size_t b) {
        const Eigen::Vector4d v = blocks[a * (a + 1) / 2 + b].cast<double>();
        return (Eigen::Matrix2d() << v(0), v(1), v(2), v(3)).finished();
      };
      const Eigen::Matrix2d P_d = block(i, i) + block(j, j) - block(j, i) - block(j, i).transpose();
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(P_d);
      const Eigen::Vector2d middle =
          glyphs.points->origin() + 0.5 * (means[i] + means[j]).cast<double>();
      const Eigen::Vector2d semi = eigen.eigenvalues().cwiseSqrt();
      Ellipsoid ellipsoid{.centre = {middle.x(), middle.y(), 0.0},
                          .axes = Eigen::Matrix3d::Zero(),
                          .colour = glyphs.colour};
      ellipsoid.axes.block<2, 2>(0, 0) = eigen.eigenvectors() * semi.asDiagonal();
      ellipsoid.axes(2, 2) = semi(0);
      expected.ellipsoids.push_back(ellipsoid);
    }
  }
  const Image reference = draw(view, expected, options());
  EXPECT_LE(difference(pairs, reference).pixels, 320 * 240 / 100);
  const Moments found = momentsOf(pairs);
  EXPECT_NEAR(found.area, momentsOf(reference).area, 0.002 * found.area);
  // With light their surfaces show which of them is in front.
  const Image lit = draw(view, scene, options(true));
  const Image lit_reference = draw(view, expected, options(true));
  int wrong = 0;
  for (int v = 0; v < lit.height; ++v) {
    for (int u = 0; u < lit.width; ++u) {
      wrong += std::abs(channel(lit, u, v, 0) - channel(lit_reference, u, v, 0)) > 5 ? 1 : 0;
    }
  }
  EXPECT_LE(wrong, 320 * 240 / 100);
  expected.ellipsoids[5].centre.z() += 0.02;  // twin
  const Image moved = draw(view, expected, options(true));
  int found_wrong = 0;
  for (int v = 0; v < lit.height; ++v) {
    for (int u = 0; u < lit.width; ++u) {
      found_wrong += std::abs(channel(lit, u, v, 0) - channel(moved, u, v, 0)) > 5 ? 1 : 0;
    }
  }
  EXPECT_GT(found_wrong, 2 * wrong + 50);
}

TEST_P(PairPicture, BothEyesAreDrawnAndEachAsIfAlone) {
  const View left = overFloor();
  View right = left;
  right.T_eye_scene.pretranslate(Eigen::Vector3d(-0.064, 0.0, 0.0));
  const Scene scene = sceneOf(someMap(20, 0.04));
  const auto both = draw(std::array{left, right}, scene, options(true));
  EXPECT_TRUE(sameBytes(both[0], draw(left, scene, options(true))));
  // The order of quads is the first eye's, which may show where an edge runs through another's
  // inside.
  EXPECT_LE(difference(both[1], draw(right, scene, options(true)), 2).pixels, 5);
  EXPECT_FALSE(sameBytes(both[0], both[1]));
}

TEST_P(PairPicture, DegeneratePairsAreDefined) {
  const View view = overFloor();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto areaOf = [&](const PairGlyphs& glyphs) {
    return momentsOf(drawn(view, sceneOf(glyphs))).area;
  };
  EXPECT_LE(areaOf(pairWith(Eigen::Matrix2d::Zero(), {0, 0})), 0.01);
  EXPECT_EQ(areaOf(pairWith(Eigen::Matrix2d::Constant(nan), {0, 0})), 0.0);
  EXPECT_EQ(stats_.pairs.not_finite, 1U);
  EXPECT_EQ(areaOf(pairWith(covarianceOf(0.1, 0.1, 0.0), {nan, 0})), 0.0);
  EXPECT_EQ(stats_.pairs.not_finite, 1U);
  // Around the eye, and wholly behind it.
  EXPECT_EQ(areaOf(pairWith(covarianceOf(1e3, 1e3, 0.0), {0, 0})), 0.0);
  EXPECT_EQ(areaOf(pairWith(covarianceOf(0.2, 0.1, 0.0), {0.1, -8.0})), 0.0);
  EXPECT_LE(areaOf(pairWith(covarianceOf(1e-12, 1e-13, 0.3), {0, 0})), 0.01);
  // A needle: its length is right and its width that of the thinnest that is drawn.
  const Image needle = drawn(view, sceneOf(pairWith(covarianceOf(0.4, 4e-6, 0.3), {0, 0})));
  const auto outline = ellipsoidOutline(ellipsoidOf(0.4, 4e-5, 0.3, {0, 0}), view);
  const Moments moments = momentsOf(needle);
  if (moments.area > 0.0) {
    EXPECT_NEAR(moments.area, outline->area_px2, 0.6 * outline->area_px2 + 0.5);
  }
}

TEST_P(PairPicture, ThousandsOfPixelsLargeOrBesideTheEyeTheyAreAsEllipsoidsOfTheScene) {
  const View view = overFloor();
  for (const auto& [major, minor, angle] :
       {std::array{7.0, 0.8, 0.1}, std::array{3.0, 0.3, 1.4}, std::array{20.0, 0.05, 0.6}}) {
    const PairGlyphs glyphs = pairWith(covarianceOf(major, minor, angle), {0.1, 0.3});
    const Image pair = drawn(view, sceneOf(glyphs));
    Scene expected;
    expected.ellipsoids = {pairEllipsoid(glyphs, 0, 1)};
    const Image reference = draw(view, expected, options());
    const double area = momentsOf(reference).area;
    EXPECT_GT(area, 500.0);
    EXPECT_NEAR(momentsOf(pair).area, area, 0.002 * area);
    int off = 0;
    for (int v = 0; v < pair.height; ++v) {
      for (int u = 0; u < pair.width; ++u) {
        off += std::abs(coverage(pair, u, v) - coverage(reference, u, v)) > 0.02 ? 1 : 0;
      }
    }
    EXPECT_LE(off, 20) << major;
    expected.ellipsoids[0].axes.col(1) *= 1.05;  // twin
    EXPECT_GT(std::abs(momentsOf(draw(view, expected, options())).area - area), 0.002 * area);
  }
}

TEST_P(PairPicture, TranslucentOnesFadeAsOneLayer) {
  const View view = overFloor();
  PairGlyphs glyphs = someMap(6, 0.2);
  const Image opaque = draw(view, sceneOf(glyphs), options());
  glyphs.colour.a = 0.5F;
  const Image faded = draw(view, sceneOf(glyphs), options());
  int inside = 0;
  for (int v = 0; v < opaque.height; ++v) {
    for (int u = 0; u < opaque.width; ++u) {
      if (coverage(faded, u, v) > 0.51) ++inside;
    }
  }
  // Twice as bright only where several edges meet.
  EXPECT_LE(inside, opaque.width * opaque.height / 50);
  EXPECT_NEAR(momentsOf(faded).area, 0.5 * momentsOf(opaque).area, 0.02 * momentsOf(opaque).area);
}

TEST_P(PairPicture, RimsKeepLargeOnesApartAndLeaveSmallOnesTheirColour) {
  const View view = overFloor();
  const double px = 2.1 / 300.0;  // m, at the middle of the picture
  /// Light of a glyph in all, as a share of what it has where nothing is shaded.
  const auto brightness = [&](double radius_px) {
    const PairGlyphs glyphs =
        pairWith(covarianceOf(radius_px * px, radius_px * px, 0.0), {0.05, 0.0});
    return momentsOf(draw(view, sceneOf(glyphs), options(true))).area /
           momentsOf(draw(view, sceneOf(glyphs), options(false))).area;
  };
  const double small = brightness(1.0);
  EXPECT_GT(small, 0.65);
  // Twin: of one that has a rim that share of it is darker.
  EXPECT_LT(brightness(5.0), small - 0.1);
}

TEST_P(PairPicture, StandAmongWhatElseIsInTheSceneByDepth) {
  const View view = overFloor();
  PairGlyphs glyphs = pairWith(covarianceOf(0.2, 0.15, 0.0), {0.0, 0.0});
  Scene scene = sceneOf(glyphs);
  const Eigen::Vector3d eye = view.T_eye_scene.inverse().translation();
  const auto middle = project(view.camera, view.T_eye_scene * Eigen::Vector3d::Zero());
  const auto at = [&](const Image& image) {
    return pixel(image, static_cast<int>(middle.x()), static_cast<int>(middle.y()));
  };
  scene.ellipsoids = {{0.3 * eye, 0.02 * Eigen::Matrix3d::Identity(), {1, 0, 0, 1}}};
  EXPECT_EQ(at(drawn(view, scene)).g, 0.0F) << "the nearer ellipsoid hides the pair";
  scene.ellipsoids[0].centre = -0.3 * eye;
  EXPECT_EQ(at(drawn(view, scene)).g, 1.0F) << "the farther one is hidden";
}

}  // namespace
}  // namespace slamscope::engine
