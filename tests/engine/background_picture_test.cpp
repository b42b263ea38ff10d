// SPDX-License-Identifier: MIT
#include <random>

#include "tests/engine/picture.hpp"

namespace slamscope::engine {
namespace {

constexpr int kWidth = 157;  // odd on purpose: rows are not aligned
constexpr int kHeight = 93;
constexpr Pinhole kPicture = {
    .width = kWidth, .height = kHeight, .fx = 100.0, .fy = 100.0, .cx = 78.0, .cy = 46.0};

std::shared_ptr<Image> noisePicture(unsigned seed, int width = kWidth, int height = kHeight) {
  std::mt19937 random(seed);
  auto image = std::make_shared<Image>(Image{width, height, {}});
  for (int i = 0; i < width * height; ++i) {
    for (int c = 0; c < 3; ++c) image->rgba.push_back(static_cast<std::uint8_t>(random()));
    image->rgba.push_back(255);
  }
  return image;
}

/// Each pixel shows the picture's at (u + du, v + dv).
std::shared_ptr<LookupMap> shift(float du, float dv) {
  auto map = std::make_shared<LookupMap>(LookupMap{kWidth, kHeight, {}});
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      map->uv_px.push_back(static_cast<float>(u) + du);
      map->uv_px.push_back(static_cast<float>(v) + dv);
    }
  }
  return map;
}

/// Bilinear with black outside, as OpenCV's remap; worst difference of a byte.
int worstAgainst(const Image& drawn, const Image& source, double du, double dv) {
  const auto texel = [&source](int u, int v, int c) {
    const bool inside = u >= 0 && v >= 0 && u < source.width && v < source.height;
    return inside ? channel(source, u, v, c) : 0;
  };
  double worst = 0.0;
  for (int v = 0; v < drawn.height; ++v) {
    for (int u = 0; u < drawn.width; ++u) {
      const int x = static_cast<int>(std::floor(u + du));
      const int y = static_cast<int>(std::floor(v + dv));
      const double a = u + du - x;
      const double b = v + dv - y;
      for (int c = 0; c < 3; ++c) {
        const double wanted = (1 - b) * ((1 - a) * texel(x, y, c) + a * texel(x + 1, y, c)) +
                              b * ((1 - a) * texel(x, y + 1, c) + a * texel(x + 1, y + 1, c));
        worst = std::max(worst, std::abs(channel(drawn, u, v, c) - wanted));
      }
    }
  }
  return static_cast<int>(std::ceil(worst - 1e-9));
}

class BackgroundPicture : public PictureTest {
 protected:
  static View viewOf(std::shared_ptr<const Image> image, std::shared_ptr<const LookupMap> map) {
    View view;
    view.camera = kPicture;
    view.background = {std::move(image), std::move(map)};
    return view;
  }
};

TEST_F(BackgroundPicture, PassesThroughToTheByte) {
  const auto image = noisePicture(1);
  EXPECT_TRUE(sameBytes(draw(viewOf(image, nullptr), {}), *image));
  EXPECT_FALSE(sameBytes(draw(viewOf(noisePicture(2), nullptr), {}), *image));
}

TEST_F(BackgroundPicture, IsOpaqueBlackWithoutAPicture) {
  const Image picture = draw(viewOf(nullptr, nullptr), {});
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
    ASSERT_EQ(picture.rgba[i], i % 4 == 3 ? 255 : 0);
  }
}

TEST_F(BackgroundPicture, WholeShiftsOfTheMapAreExactAndBlackOutside) {
  const auto image = noisePicture(3);
  const Image picture = draw(viewOf(image, shift(3, -2)), {});
  EXPECT_EQ(worstAgainst(picture, *image, 3, -2), 0);
  EXPECT_GT(worstAgainst(picture, *image, 3, -1), 0);
  EXPECT_GT(worstAgainst(picture, *image, 3.5, -2), 2) << "twin: half a pixel off";
  EXPECT_EQ(channel(picture, 5, 0, 0), 0);
}

TEST_F(BackgroundPicture, FractionsOfAPixelAreBilinear) {
  const auto image = noisePicture(4);
  EXPECT_LE(worstAgainst(draw(viewOf(image, shift(0.5F, 0)), {}), *image, 0.5, 0), 1);
  EXPECT_LE(worstAgainst(draw(viewOf(image, shift(-0.25F, 0.75F)), {}), *image, -0.25, 0.75), 1);
  EXPECT_GT(worstAgainst(draw(viewOf(image, shift(0.5F, 0)), {}), *image, 0.25, 0), 2);
}

TEST_F(BackgroundPicture, MapMayPointNowhereAndToAPictureOfAnotherSize) {
  auto map = shift(20, 10);
  map->uv_px[0] = std::numeric_limits<float>::quiet_NaN();
  map->uv_px[2] = 1e30F;
  map->uv_px[4] = -std::numeric_limits<float>::infinity();
  const auto image = noisePicture(5, 300, 200);
  const Image picture = draw(viewOf(image, map), {});
  for (int u = 0; u < 3; ++u) EXPECT_EQ(channel(picture, u, 0, 1), 0);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(channel(picture, 40, 30, c), channel(*image, 60, 40, c));
  }
}

TEST_F(BackgroundPicture, FollowsANewPictureAndANewMap) {
  Offscreen offscreen(gpu_, kWidth, kHeight);
  const auto show = [&offscreen](const View& view) {
    return offscreen.draw({&view, 1}, {}, flat()).front();
  };
  const auto first = noisePicture(6);
  const auto map = shift(1, 0);
  EXPECT_EQ(worstAgainst(show(viewOf(first, map)), *first, 1, 0), 0);
  const auto second = noisePicture(7);
  EXPECT_EQ(worstAgainst(show(viewOf(second, map)), *second, 1, 0), 0);
  EXPECT_EQ(worstAgainst(show(viewOf(second, shift(-4, 5))), *second, -4, 5), 0);
  EXPECT_TRUE(sameBytes(show(viewOf(second, nullptr)), *second));
}

}  // namespace
}  // namespace slamscope::engine
