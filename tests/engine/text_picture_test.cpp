// SPDX-License-Identifier: MIT
#include "engine/scene/text_layout.hpp"
#include "tests/engine/picture.hpp"

namespace slamscope::engine {
namespace {

constexpr Pinhole kTextCamera = {
    .width = 200, .height = 120, .fx = 200.0, .fy = 200.0, .cx = 99.5, .cy = 59.5};

View straight() {
  View view;
  view.camera = kTextCamera;
  return view;
}

/// White letters on black, set texel by texel on the CPU at a whole-pixel corner.
Image typeset(const std::string& text, double height_px, int corner_u, int corner_v) {
  FontAtlas atlas;
  Image image{kTextCamera.width, kTextCamera.height, {}};
  for (int i = 0; i < kTextCamera.width * kTextCamera.height; ++i) {
    image.rgba.insert(image.rgba.end(), {0, 0, 0, 255});
  }
  for (const GlyphQuad& quad : layoutText(atlas, text, height_px)) {
    const Eigen::Vector2i size = (quad.max_px - quad.min_px).cast<int>();
    for (int y = 0; y < size.y(); ++y) {
      for (int x = 0; x < size.x(); ++x) {
        const int texel_u = static_cast<int>(quad.min_uv.x()) + x;
        const int texel_v = static_cast<int>(quad.min_uv.y()) + y;
        const double a =
            atlas.pixels()[2 * (static_cast<std::size_t>(texel_v) * atlas.width() + texel_u)] /
            255.0;
        const int u = corner_u + static_cast<int>(quad.min_px.x()) + x;
        const int v = corner_v + static_cast<int>(quad.min_px.y()) + y;
        if (u < 0 || v < 0 || u >= image.width || v >= image.height) continue;
        std::uint8_t* p = &image.rgba[4 * (static_cast<std::size_t>(v) * image.width + u)];
        for (int c = 0; c < 3; ++c) {
          p[c] = static_cast<std::uint8_t>(std::lround(255.0 * a + (1.0 - a) * p[c]));
        }
      }
    }
  }
  return image;
}

class TextPicture : public PictureTest {};

TEST_F(TextPicture, IsTheAtlasTexelByTexelAtItsPlace) {
  Scene scene;
  scene.texts = {{{20, 30}, "k = 3 σ\n105 pairs", 18, kWhite}};
  const Image picture = draw(straight(), scene);
  EXPECT_LE(difference(picture, typeset("k = 3 σ\n105 pairs", 18, 20, 30)).most, 1);
  EXPECT_GT(difference(picture, typeset("k = 3 σ\n105 pairs", 18, 21, 30)).most, 50);
}

TEST_F(TextPicture, LabelsAreCentredOnTheirAnchorsPictureAndOffset) {
  Scene scene;
  scene.labels = {{{0.1, -0.05, 1.0}, {0, 15}, "17", 16, kWhite}};
  FontAtlas atlas;
  const TextExtent extent = measureText(atlas, "17", 16);
  // The anchor's picture is pixel (119.5, 49.5), that is (120, 50) from the picture's corner.
  const auto u = static_cast<int>(std::floor(120.0 - extent.width_px / 2 + 0.5));
  const auto v = static_cast<int>(std::floor(65.0 - extent.height_px / 2 + 0.5));
  EXPECT_LE(difference(draw(straight(), scene), typeset("17", 16, u, v)).most, 1);
  EXPECT_GT(difference(draw(straight(), scene), typeset("17", 16, u, v + 1)).most, 50);
  scene.labels[0].anchor.z() = -1.0;  // behind the eye
  EXPECT_LE(momentsOf(draw(straight(), scene)).area, 0.0);
}

TEST_F(TextPicture, HasADarkHaloThatReadsOnWhite) {
  View view = straight();
  view.background.image = std::make_shared<Image>(
      Image{200, 120, std::vector<std::uint8_t>(std::size_t{4} * 200 * 120, 255)});
  Scene scene;
  scene.texts = {{{20, 30}, "17", 24, kWhite}};
  const auto darkest = [](const Image& image) { return *std::ranges::min_element(image.rgba); };
  EXPECT_LT(darkest(draw(view, scene, {})), 100);
  EXPECT_EQ(darkest(draw(view, scene, flat())), 255);
}

TEST_F(TextPicture, NewLettersAppearInLaterFrames) {
  Offscreen offscreen(gpu_, kTextCamera.width, kTextCamera.height);
  const View view = straight();
  Scene scene;
  for (const std::string text : {"abc", "xyz ÄÖÜ", "0123456789\nABCDEFGHIJ"}) {
    scene.texts = {{{5, 5}, text, 40, kWhite}};
    const Image picture = offscreen.draw({&view, 1}, scene, flat()).front();
    EXPECT_LE(difference(picture, typeset(text, 40, 5, 5)).most, 1) << text;
  }
}

TEST_F(TextPicture, RectsCoverFractionsOfPixelsAndLieUnderTexts) {
  Scene scene;
  scene.rects = {{{10.25, 20.0}, {50.0, 40.5}, kWhite}};
  const Image picture = draw(straight(), scene);
  EXPECT_NEAR(momentsOf(picture).area, 39.75 * 20.5, 0.5);
  EXPECT_NEAR(coverage(picture, 10, 30), 0.75, 0.003);
  EXPECT_NEAR(coverage(picture, 10, 40), 0.375, 0.003);
  EXPECT_EQ(channel(picture, 9, 30, 0), 0);
  scene.rects[0].colour = {0, 0, 1, 1};
  scene.texts = {{{12, 20}, "##", 16, {1, 0, 0, 1}}};
  EXPECT_GT(momentsOf(draw(straight(), scene)).area, 20.0);
}

}  // namespace
}  // namespace slamscope::engine
