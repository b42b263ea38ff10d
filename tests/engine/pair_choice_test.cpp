// SPDX-License-Identifier: MIT
#include "tests/engine/pair_scene.hpp"

// Which pairs are drawn, in which of the two ways, and what is sent to the device for it.
namespace slamscope::engine {
namespace {

TEST_P(PairPicture, PointsAreSentOnceAndNotAgainWhenOnlyTheViewerMoves) {
  const View view = overFloor();
  const Scene scene = sceneOf(someMap(40, 0.02));
  Offscreen offscreen(gpu_, view.camera.width, view.camera.height);
  (void)offscreen.draw({&view, 1}, scene, options());
  EXPECT_EQ(offscreen.lastStats().pairs.uploaded_bytes, 40U * 8 + 820U * 16);
  const View moved = lookingAt(kFloorCamera, {0.4, -1.2, 1.6}, {0, 0, 0});
  const Image picture = offscreen.draw({&moved, 1}, scene, options()).front();
  EXPECT_EQ(offscreen.lastStats().pairs.uploaded_bytes, 0U);
  EXPECT_TRUE(sameBytes(picture, draw(moved, scene, options())));
  (void)offscreen.draw({&view, 1}, sceneOf(someMap(40, 0.03)), options());
  EXPECT_GT(offscreen.lastStats().pairs.uploaded_bytes, 0U);
}

TEST_P(PairPicture, ConditionsChooseThePairsAndAreCounted) {
  const View view = overFloor();
  PairGlyphs glyphs = someMap(10, 0.03);
  const auto chosen = [&](const PairChoice& choice) {
    glyphs.choice = choice;
    (void)draw(view, sceneOf(glyphs), options());
    return stats_.pairs.chosen;
  };
  EXPECT_EQ(chosen({}), 45U);
  EXPECT_EQ(stats_.pairs.all, 45U);
  EXPECT_EQ(chosen({.groups = {0, 0, 0, 0, 1, 1, 1, 2, 2, 2}}), 4U * 6 + 3U * 3);
  EXPECT_EQ(chosen({.touching = {3}}), 9U);
  EXPECT_EQ(chosen({.touching = {3, 7}}), 17U);
  EXPECT_EQ(chosen({.left_out = {{2, 5}, {5, 1}, {9, 8}}}), 42U);
  EXPECT_EQ(chosen({.most = 7}), 7U);
  EXPECT_EQ(chosen({.most = 44}), 44U);
  EXPECT_EQ(chosen({.most = 100}), 45U);
  EXPECT_EQ(chosen({.touching = {3}, .most = 4}), 4U);
  EXPECT_EQ(chosen({.least_area = 1e6}), 0U);
  EXPECT_EQ(stats_.pairs.drawn, 0U);
}

TEST_P(PairPicture, TheMostAreThoseOfTheGreatestArea) {
  const View view = overFloor();
  PairGlyphs glyphs = someMap(12, 0.03);
  const auto chosenFrom = [&](double least_area) {
    glyphs.choice = {.least_area = least_area};
    (void)draw(view, sceneOf(glyphs), options());
    return stats_.pairs.chosen;
  };
  // The area that exactly ten pass, by halving.
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 40 && chosenFrom(low) != 10; ++i) {
    const double middle = 0.5 * (low + high);
    (chosenFrom(middle) >= 10 ? low : high) = middle;
  }
  ASSERT_EQ(chosenFrom(low), 10U);
  const Image by_area = draw(view, sceneOf(glyphs), options());
  glyphs.choice = {.most = 10};
  EXPECT_TRUE(sameBytes(by_area, draw(view, sceneOf(glyphs), options())));
  glyphs.choice = {.most = 11};
  EXPECT_FALSE(sameBytes(by_area, draw(view, sceneOf(glyphs), options())));
}

TEST_P(PairPicture, OnlyThoseInThePictureAreCountedAsDrawn) {
  const View view = overFloor();
  PairGlyphs glyphs = pairWith(covarianceOf(0.1, 0.1, 0.0), {0.0, 0.0});
  (void)drawn(view, sceneOf(glyphs));
  EXPECT_EQ(stats_.pairs.drawn, 1U);
  glyphs = pairWith(covarianceOf(0.1, 0.1, 0.0), {40.0, 0.0});
  (void)drawn(view, sceneOf(glyphs));
  EXPECT_EQ(stats_.pairs.chosen, 1U);
  EXPECT_EQ(stats_.pairs.drawn, 0U);
}

class PairWays : public PairTest {};

TEST_F(PairWays, GiveTheSamePictureButForPixelsWhereEdgesMeet) {
  const View view = overFloor();
  struct Case {
    int points;
    bool lit;
    double share;  ///< of the picture's pixels; the more ellipsoids, the more edges meet
  };
  for (const auto& [points, lit, share] :
       {Case{14, false, 0.02}, {14, true, 0.02}, {50, true, 0.03}}) {
    constexpr double sigma = 0.03;
    const Scene scene = sceneOf(someMap(points, sigma));
    const Image quads = draw(view, scene, {.lit = lit, .pair_way = PairWay::quads});
    const Image splats = draw(view, scene, {.lit = lit, .pair_way = PairWay::splats});
    const int off = difference(quads, splats, 5).pixels;
    EXPECT_LE(off, share * quads.width * quads.height) << points;
    const double area = momentsOf(quads).area;
    EXPECT_NEAR(momentsOf(splats).area, area, 0.01 * area) << points;
    const Scene other = sceneOf(someMap(points, 1.03 * sigma));
    EXPECT_GT(difference(quads, draw(view, other, {.lit = lit})).pixels, off) << points;
  }
}

TEST_F(PairWays, AreChosenByTheNumberOfPairs) {
  const View view = overFloor();
  (void)draw(view, sceneOf(someMap(15, 0.03)), {});
  EXPECT_FALSE(stats_.pairs.splatted);
  (void)draw(view, sceneOf(someMap(60, 0.03)), {});
  EXPECT_TRUE(stats_.pairs.splatted);
}

TEST_F(PairWays, WithoutWideAtomicsQuadsDoItAll) {
  useGpu(GpuOptions{.validation = true, .wide_atomics = false});
  const Scene scene = sceneOf(someMap(60, 0.01));
  (void)draw(overFloor(), scene, {.pair_way = PairWay::splats});
  EXPECT_FALSE(stats_.pairs.splatted);
  EXPECT_EQ(stats_.pairs.chosen, 1770U);
}

TEST_F(PairWays, PointsThatNoBufferTakesAreSaidSo) {
  const Scene scene = sceneOf(someMap(60, 0.01));
  useGpu(GpuOptions{.validation = true, .most_texels = 1830U});
  (void)draw(overFloor(), scene, {});
  EXPECT_EQ(stats_.pairs.problem, "");
  EXPECT_FALSE(stats_.pairs.splatted) << "what splatting needs besides doesn't fit either";
  EXPECT_EQ(stats_.pairs.chosen, 1770U);
  useGpu(GpuOptions{.validation = true, .most_texels = 1829U});
  (void)draw(overFloor(), scene, {});
  EXPECT_NE(stats_.pairs.problem.find("60 points"), std::string::npos);
  EXPECT_EQ(stats_.pairs.chosen, 0U);
}

/// Without a dense matrix, which would be four times as large: uncorrelated, one pair apart.
PairGlyphs largeMap(int n) {
  std::vector<Eigen::Vector2d> means;
  std::vector<double> lower(std::size_t(n) * std::size_t(2 * n + 1), 0.0);
  for (int i = 0; i < n; ++i) {
    means.emplace_back(0.8 * std::cos(1.7 * i), 0.8 * std::sin(2.3 * i));
    for (const std::size_t row : {std::size_t(2 * i), std::size_t(2 * i + 1)}) {
      lower[row * (row + 1) / 2 + row] = 1e-6 * (1 + i % 3);
    }
  }
  return {.points = std::make_shared<PlanarPoints>(means, lower),
          .axis = {},
          .choice = {},
          .colour = kWhite};
}

TEST_F(PairWays, TheLeastDeviceSplatsTwoThousandThreeHundredPoints) {
  useGpu(GpuOptions{
      .validation = true, .most_texels = kLeastTexels, .most_storage_bytes = kLeastStorageBytes});
  const View view = overFloor();
  (void)draw(view, sceneOf(largeMap(2300)), {});
  EXPECT_EQ(stats_.pairs.problem, "");
  EXPECT_TRUE(stats_.pairs.splatted);
  EXPECT_EQ(stats_.pairs.chosen, 2'643'850U);
  EXPECT_GT(stats_.pairs.drawn, 2'600'000U) << "but for those beyond the picture's edge";
}

TEST_F(PairWays, WithSmallerStorageBuffersQuadsDoItAll) {
  const Scene scene = sceneOf(someMap(60, 0.01));
  useGpu(GpuOptions{.validation = true, .most_storage_bytes = 320 * 240 * 16});
  (void)draw(overFloor(), scene, {});
  EXPECT_TRUE(stats_.pairs.splatted);
  useGpu(GpuOptions{.validation = true, .most_storage_bytes = 320 * 240 * 16 - 1});
  (void)draw(overFloor(), scene, {});
  EXPECT_FALSE(stats_.pairs.splatted);
  EXPECT_EQ(stats_.pairs.chosen, 1770U);
}

TEST(PlanarPoints, NeedTheWholeTriangle) {
  const std::vector<Eigen::Vector2d> means(3, Eigen::Vector2d::Zero());
  EXPECT_NO_THROW(PlanarPoints(means, std::vector<double>(45), 3));
  EXPECT_THROW(PlanarPoints(means, std::vector<double>(44), 3), std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::engine
