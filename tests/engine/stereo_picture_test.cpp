// SPDX-License-Identifier: MIT
#include "tests/engine/picture.hpp"

namespace slamscope::engine {
namespace {

constexpr Pinhole kEye = {
    .width = 320, .height = 240, .fx = 300.0, .fy = 300.0, .cx = 160.2, .cy = 118.4};

View besides(const View& left, double baseline) {
  View right = left;
  right.T_eye_scene.pretranslate(Eigen::Vector3d(-baseline, 0, 0));
  return right;
}

Scene everything() {
  Scene scene;
  scene.ellipsoids = {{{0, 0, 0}, Eigen::Vector3d(0.2, 0.1, 0.1).asDiagonal(), {1, 0, 0, 0.7F}}};
  scene.cones = {{{0.3, 0.1, 0}, 0.2, 0.06, {0, 1, 1, 1}}};
  scene.arrows = {{{-0.3, 0, 0}, 0.5, 0.3, 0.1, {1, 1, 0, 1}}};
  scene.lines = {{{{-0.5, -0.2, 0}, {0.4, 0.3, 0}, {0.5, -0.3, 0}}, 3.0, {0, 1, 0, 1}}};
  scene.labels = {{{0.3, 0.1, 0}, {0, 12}, "42", 14, kWhite}};
  // Some reach past the picture: lavapipe draws what it has to clip into the first eye's picture.
  scene.ellipsoids.push_back(
      {{0.9, 0, 0}, Eigen::Vector3d(0.3, 0.1, 0.1).asDiagonal(), {1, 0, 0, 0.7F}});
  scene.ellipsoids.push_back(
      {{-2.5, 0, 0}, Eigen::Vector3d(2.0, 0.1, 0.1).asDiagonal(), {0, 0, 1, 0.7F}});
  scene.cones.push_back({{-0.75, 0.3, 0}, 0.3, 0.1, {0, 1, 1, 1}});
  scene.arrows.push_back({{0.5, -0.4, 0}, -0.4, 0.9, 0.2, {1, 1, 0, 1}});
  scene.lines.push_back({{{-9, 0.1, 0}, {9, 0.2, 0}}, 4.0, {1, 1, 1, 0.5F}});
  scene.labels.push_back({{-0.68, -0.1, 0}, {0, 0}, "far out", 14, kWhite});
  scene.rects = {{{5, 5}, {100, 40}, {0, 0, 0, 0.5F}}, {{300, 200}, {400, 300}, {0, 1, 0, 0.5F}}};
  scene.texts = {{{10, 10}, "legend", 14, kWhite}};
  return scene;
}

class StereoPicture : public PictureTest {};

TEST_F(StereoPicture, WithoutBaselineBothEyesAreTheSameToTheByte) {
  View view = lookingAt(kEye, {0.1, -1.2, 0.9}, {0, 0, 0});
  auto noise = std::make_shared<Image>(Image{320, 240, {}});
  for (unsigned i = 0; i < 320 * 240 * 4; ++i) {
    noise->rgba.push_back(static_cast<std::uint8_t>((i * 7919U) >> 3U));
  }
  view.background.image = noise;
  const std::array same = {view, view};
  const auto pictures = draw(same, everything(), {});
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_TRUE(sameBytes(pictures[0], pictures[1]));
  EXPECT_TRUE(sameBytes(pictures[0], draw(view, everything(), {}))) << "one view alone";

  const std::array apart = {view, besides(view, 0.001)};
  const auto different = draw(apart, everything(), {});
  EXPECT_FALSE(sameBytes(different[0], different[1]));
}

TEST_F(StereoPicture, DisparityIsFocalLengthTimesBaselineByDepth) {
  const View left = lookingAt(kEye, {0, -2, 0.001}, {0, 0, 0});
  const double baseline = 0.064;
  const std::array views = {left, besides(left, baseline)};
  for (const double depth : {1.0, 2.0, 6.0}) {
    Scene scene;
    scene.ellipsoids = {{{0.1, depth - 2.0, 0}, 0.02 * Eigen::Matrix3d::Identity(), kWhite}};
    const auto pictures = draw(views, scene, flat());
    const double found = momentsOf(pictures[0]).centre.x() - momentsOf(pictures[1]).centre.x();
    EXPECT_NEAR(found, kEye.fx * baseline / depth, 0.02);
    EXPECT_GT(std::abs(found - kEye.fx * 0.070 / depth), 0.02) << "twin: another baseline";
  }
}

TEST_F(StereoPicture, EachEyeHasItsOwnBackgroundAndMap) {
  const auto plain = [](std::uint8_t grey) {
    return std::make_shared<Image>(
        Image{320, 240, std::vector<std::uint8_t>(std::size_t{4} * 320 * 240, grey)});
  };
  auto map = std::make_shared<LookupMap>(LookupMap{320, 240, {}});
  map->uv_px.assign(std::size_t{2} * 320 * 240, 100.0F);
  std::array views = {lookingAt(kEye, {0, -1, 1}, {0, 0, 0}),
                      lookingAt(kEye, {0, -1, 1}, {0, 0, 0})};
  views[0].background.image = plain(10);
  views[1].background = {plain(200), map};
  const auto pictures = draw(views, {}, flat());
  EXPECT_EQ(channel(pictures[0], 50, 60, 1), 10);
  EXPECT_EQ(channel(pictures[1], 50, 60, 1), 200);
}

std::shared_ptr<Image> noise(unsigned seed) {
  auto picture = std::make_shared<Image>(Image{320, 240, {}});
  for (unsigned i = 0; i < 320 * 240 * 4; ++i) {
    picture->rgba.push_back(static_cast<std::uint8_t>(((i + seed) * 2654435761U) >> 21U));
  }
  return picture;
}

std::array<View, 2> noisyEyes() {
  View view = lookingAt(kEye, {0.1, -1.2, 0.9}, {0, 0, 0});
  view.background.image = noise(1);
  std::array views = {view, besides(view, 0.064)};
  views[1].background.image = noise(77);
  return views;
}

TEST_F(StereoPicture, PlainLensesChangeNoByteAndOneThatIsNotChangesItsEyeAlone) {
  Offscreen offscreen(gpu_, 320, 240, 2);
  const auto views = noisyEyes();
  const auto bare = offscreen.draw(views, everything(), {});
  std::array<Lens, 2> lenses;
  offscreen.wear(lenses);
  const auto plain = offscreen.draw(views, everything(), {});
  EXPECT_TRUE(sameBytes(bare[0], plain[0]) && sameBytes(bare[1], plain[1]));
  lenses[1].k = {0.1, 0, 0};
  offscreen.wear(lenses);
  const auto worn = offscreen.draw(views, everything(), {});
  EXPECT_TRUE(sameBytes(bare[0], worn[0]));
  EXPECT_FALSE(sameBytes(bare[1], worn[1])) << "twin";
  offscreen.wear({});
  EXPECT_TRUE(sameBytes(bare[1], offscreen.draw(views, everything(), {})[1])) << "taken off";
  EXPECT_THROW(offscreen.wear({lenses.data(), 1}), std::invalid_argument);
}

/// A channel between pixels; outside black.
double between(const Image& image, const Eigen::Vector2d& px, int c) {
  const int u = static_cast<int>(std::floor(px.x())), v = static_cast<int>(std::floor(px.y()));
  const auto at = [&](int x, int y) {
    const bool inside = x >= 0 && y >= 0 && x < image.width && y < image.height;
    return inside ? channel(image, x, y, c) : 0;
  };
  const double a = px.x() - u, b = px.y() - v;
  return (1 - b) * ((1 - a) * at(u, v) + a * at(u + 1, v)) +
         b * ((1 - a) * at(u, v + 1) + a * at(u + 1, v + 1));
}

TEST_F(StereoPicture, LensShowsEachColourWhereItsEquationPutsIt) {
  Offscreen offscreen(gpu_, 320, 240, 2);
  const auto views = noisyEyes();
  const auto bare = offscreen.draw(views, everything(), {});
  std::array<Lens, 2> lenses;
  lenses[0] = {.centre = {0.53, 0.48}, .k = {0.22, 0.1, 0.02}, .scale = {0.99, 1.0, 1.012}};
  lenses[1] = {.centre = {0.47, 0.48}, .k = {0.15, 0, 0}, .scale = {0.8, 0.8, 0.8}};
  offscreen.wear(lenses);
  const auto worn = offscreen.draw(views, everything(), {});
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const Lens& lens = lenses[eye];
    const Eigen::Vector2d axis(lens.centre.x() * 320 - 0.5, lens.centre.y() * 240 - 0.5);
    double worst = 0.0, twin = 0.0;
    for (int v = 0; v < 240; ++v) {
      for (int u = 0; u < 320; ++u) {
        const Eigen::Vector2d off = Eigen::Vector2d(u, v) - axis;
        const double s = (off / 120).squaredNorm();
        const double factor = 1 + s * (lens.k[0] + s * (lens.k[1] + s * lens.k[2]));
        const Eigen::Vector2d green = axis + lens.scale[1] * factor * off;
        EXPECT_LT((green - drawnPixel(lens, {320, 240}, {u, v})).norm(), 1e-9);
        for (int c = 0; c < 3; ++c) {
          const Eigen::Vector2d from = axis + lens.scale[c] * factor * off;
          const int found = channel(worn[eye], u, v, c);
          worst = std::max(worst, std::abs(found - between(bare[eye], from, c)));
          const Eigen::Vector2d half_off = from.array() + 0.5;
          twin = std::max(twin, std::abs(found - between(bare[eye], half_off, c)));
        }
      }
    }
    EXPECT_LT(worst, 3.0) << "of 255";  // the sampler's weights have 8 bits
    EXPECT_GT(twin, 50.0) << "twin: half a pixel off";
  }
}

TEST_F(StereoPicture, RefusesWhatDoesNotFit) {
  Offscreen offscreen(gpu_, 320, 240, 2);
  const View view = lookingAt(kEye, {0, -1, 1}, {0, 0, 0});
  EXPECT_THROW((void)offscreen.draw({&view, 1}, {}), std::invalid_argument);
  std::array views = {view, view};
  views[1].camera.width = 321;
  EXPECT_THROW((void)offscreen.draw(views, {}), std::invalid_argument);
  views[1] = view;
  views[1].background.image = std::make_shared<Image>(Image{8, 8, std::vector<std::uint8_t>(256)});
  EXPECT_THROW((void)offscreen.draw(views, {}), std::invalid_argument);
  EXPECT_THROW(Offscreen(gpu_, 0, 240), std::invalid_argument);
  EXPECT_THROW(Offscreen(gpu_, 320, 240, 3), std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::engine
