// SPDX-License-Identifier: MIT
#include <map>
#include <numeric>

#include "engine/scene/clip.hpp"
#include "engine/scene/pair_ellipsoid.hpp"
#include "tests/engine/pair_scene.hpp"

// Pairs that come first because they grew, against double precision.
namespace slamscope::engine {
namespace {

using Names = std::vector<std::uint64_t>;
using Named = std::pair<std::uint64_t, std::uint64_t>;
using Areas = std::map<Named, double>;

/// Some points of a plane, by name, and what their covariance is after `step` steps.
PlanarPointsPtr mapOf(const Names& names, int step) {
  std::vector<Eigen::Vector2d> means;
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(2 * int(names.size()), 2 * int(names.size()));
  for (int i = 0; i < int(names.size()); ++i) {
    const auto name = static_cast<double>(names[std::size_t(i)]);
    means.emplace_back(0.7 * std::cos(2.4 * name), 0.7 * std::sin(1.9 * name));
    const double sigma = 0.03 * (1.0 + 0.4 * std::sin(name + 1.7 * step * std::cos(name)));
    P.block<2, 2>(2 * i, 2 * i) = covarianceOf(sigma, 0.5 * sigma, name);
  }
  return std::make_shared<PlanarPoints>(means, packed(P), 0, names);
}

Areas areasOf(const PlanarPoints& points) {
  Areas areas;
  for (std::uint32_t j = 1; j < std::uint32_t(points.count()); ++j) {
    for (std::uint32_t i = 0; i < j; ++i) {
      areas[std::minmax(points.names()[i], points.names()[j])] =
          std::sqrt(differenceCovariance(points, i, j).determinant());
    }
  }
  return areas;
}

/// Ratios to what was, by name; those that were not grow by 1.
Areas growthOf(const Areas& now, const Areas& then) {
  Areas growth;
  for (const auto& [pair, area] : now) {
    const auto was = then.find(pair);
    growth[pair] = was == then.end() ? 1.0 : area / was->second;
  }
  return growth;
}

/// The map's pairs but the `count` that grew most, by index.
PairChoice theMost(const PlanarPoints& points, const Areas& growth, std::size_t count) {
  std::vector<double> sorted;
  for (const auto& [pair, ratio] : growth) sorted.push_back(ratio);
  std::ranges::sort(sorted, std::greater<>());
  PairChoice choice;
  for (std::uint32_t j = 1; j < std::uint32_t(points.count()); ++j) {
    for (std::uint32_t i = 0; i < j; ++i) {
      const double ratio = growth.at(std::minmax(points.names()[i], points.names()[j]));
      if (ratio < sorted[count - 1]) choice.left_out.emplace_back(i, j);
    }
  }
  return choice;
}

class PairsThatGrow : public PairPicture {
 protected:
  static constexpr std::uint32_t kMost = 7;

  Image drawMost(const PlanarPointsPtr& points, MostBy by) {
    return drawChosen(points, {.most = kMost, .most_by = by});
  }
  Image drawChosen(const PlanarPointsPtr& points, const PairChoice& choice) {
    return draw(overFloor(),
                sceneOf({.points = points, .axis = {}, .choice = choice, .colour = kWhite}),
                options());
  }
  void expectMost(const Image& drawn, const PlanarPointsPtr& points, const Areas& growth) {
    EXPECT_EQ(stats_.pairs.chosen, kMost);
    const auto greatest = std::ranges::max_element(
        growth, [](const auto& a, const auto& b) { return a.second < b.second; });
    EXPECT_NEAR(stats_.pairs.greatest_growth, greatest->second, 1e-3 * greatest->second);
    EXPECT_TRUE(sameBytes(drawn, drawChosen(points, theMost(*points, growth, kMost))));
    // Twin: one more is another picture.
    EXPECT_FALSE(sameBytes(drawn, drawChosen(points, theMost(*points, growth, kMost + 1))));
  }
};

INSTANTIATE_TEST_SUITE_P(Ways, PairsThatGrow, ::testing::Values(PairWay::quads, PairWay::splats),
                         [](const auto& way) {
                           return way.param == PairWay::quads ? "Quads" : "Splats";
                         });

Names namesFrom(std::uint64_t first, std::size_t count) {
  Names names(count);
  std::iota(names.begin(), names.end(), first);
  return names;
}

TEST_P(PairsThatGrow, SinceTheyWereFirstDrawn) {
  const Names names = namesFrom(1, 12);
  const std::array maps{mapOf(names, 0), mapOf(names, 1), mapOf(names, 2)};
  for (const PlanarPointsPtr& map : maps) (void)drawMost(map, MostBy::growth);
  const Image drawn = drawMost(maps[2], MostBy::growth);  // once more: nothing new
  expectMost(drawn, maps[2], growthOf(areasOf(*maps[2]), areasOf(*maps[0])));
}

TEST_P(PairsThatGrow, SinceThePointsBefore) {
  const Names names = namesFrom(1, 12);
  const std::array maps{mapOf(names, 0), mapOf(names, 1), mapOf(names, 2)};
  for (const PlanarPointsPtr& map : maps) (void)drawMost(map, MostBy::last_growth);
  const Image drawn = drawMost(maps[2], MostBy::last_growth);
  expectMost(drawn, maps[2], growthOf(areasOf(*maps[2]), areasOf(*maps[1])));
}

TEST_P(PairsThatGrow, AreKnownByNameWhereverTheyStandAndNewOnesHaveNotGrown) {
  Names names = namesFrom(1, 12);
  const PlanarPointsPtr first = mapOf(names, 0);
  (void)drawMost(first, MostBy::growth);
  std::ranges::reverse(names);
  names.erase(names.begin() + 4);
  names.insert(names.begin() + 2, 40);
  names.push_back(41);
  const PlanarPointsPtr second = mapOf(names, 1);
  const Image drawn = drawMost(second, MostBy::growth);
  expectMost(drawn, second, growthOf(areasOf(*second), areasOf(*first)));
}

TEST_P(PairsThatGrow, AreNotThoseOfTheGreatestArea) {
  const Names names = namesFrom(1, 12);
  (void)drawMost(mapOf(names, 0), MostBy::growth);
  const PlanarPointsPtr map = mapOf(names, 1);
  const Image by_growth = drawMost(map, MostBy::growth);
  EXPECT_FALSE(sameBytes(by_growth, drawMost(map, MostBy::area)));
  EXPECT_EQ(stats_.pairs.greatest_growth, 0.0F);
}

TEST_P(PairPicture, PairsInViewAreThoseOfPointsInThePictureOfAnyView) {
  PairGlyphs glyphs = someMap(9, 0.02);
  glyphs.choice.in_view = true;
  const View left = lookingAt(kFloorCamera, {0.0, -1.0, 0.8}, {-0.4, 0.0, 0.0});
  const View right = lookingAt(kFloorCamera, {0.0, -1.0, 0.8}, {0.4, 0.0, 0.0});
  const auto seen = [&](const View& view, std::size_t i) {
    const Eigen::Vector2d p = glyphs.points->origin() + glyphs.points->means()[i].cast<double>();
    const Eigen::Vector3d p_eye = view.T_eye_scene * Eigen::Vector3d(p.x(), p.y(), 0.0);
    const Eigen::Vector2d px = project(view.camera, p_eye);
    return p_eye.z() > 0.0 && px.x() >= -0.5 && px.y() >= -0.5 && px.x() < 319.5 && px.y() < 239.5;
  };
  const auto pairsOf = [](std::size_t n) { return n * (n - 1) / 2; };
  std::size_t in_left = 0;
  std::size_t in_either = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    in_left += seen(left, i) ? 1 : 0;
    in_either += seen(left, i) || seen(right, i) ? 1 : 0;
  }
  ASSERT_LT(in_left, in_either);
  (void)drawn(left, sceneOf(glyphs));
  EXPECT_EQ(stats_.pairs.chosen, pairsOf(in_left));
  (void)draw(std::array{left, right}, sceneOf(glyphs), options());
  EXPECT_EQ(stats_.pairs.chosen, pairsOf(in_either));
  // Twin: without the condition all are.
  glyphs.choice.in_view = false;
  (void)drawn(left, sceneOf(glyphs));
  EXPECT_EQ(stats_.pairs.chosen, 36U);
}

TEST_P(PairPicture, OfPairsInViewTheMostAreFoundAnewWhereTheViewerMoves) {
  PairGlyphs glyphs = someMap(20, 0.02);
  glyphs.choice = {.most = 3, .in_view = true};
  const View near = lookingAt(kFloorCamera, {-0.2, -0.9, 1.0}, {-0.2, 0.0, 0.0});
  const View far = lookingAt(kFloorCamera, {0.0, -2.6, 2.6}, {0.0, 0.0, 0.0});
  (void)drawn(near, sceneOf(glyphs));
  EXPECT_EQ(stats_.pairs.chosen, 3U);
  const Image moved = drawn(far, sceneOf(glyphs));
  EXPECT_EQ(stats_.pairs.uploaded_bytes, 0U);
  glyphs.choice.in_view = false;  // all are in view there
  EXPECT_TRUE(sameBytes(moved, drawn(far, sceneOf(glyphs))));
}

}  // namespace
}  // namespace slamscope::engine
