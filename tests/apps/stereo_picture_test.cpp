// SPDX-License-Identifier: MIT
#include "apps/lib/view/stereo_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace slamscope::apps {
namespace {

constexpr int kWidth = 160, kHeight = 120;

/// Waves of a different length in each colour: smooth, and nowhere the same for long.
tracking::Frame waves() {
  tracking::Frame frame{.source = {}, .width = kWidth, .height = kHeight, .bgr = {}};
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      for (const double length : {31.0, 23.0, 41.0}) {
        const double wave = std::sin(column / length * 6.28) * std::cos(row / length * 6.28);
        frame.bgr.push_back(static_cast<std::uint8_t>(std::lround(128 + 100 * wave)));
      }
    }
  }
  return frame;
}

engine::LookupMap mapOf(double shift) {
  engine::LookupMap map{kWidth, kHeight, {}};
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      map.uv_px.push_back(static_cast<float>(column + shift));
      map.uv_px.push_back(static_cast<float>(row));
    }
  }
  return map;
}

engine::Image pictureOf(const tracking::Frame& frame) {
  const engine::LookupMap same = mapOf(0);
  engine::Image picture;
  Resampler(std::span(&same, 1))(frame, picture);
  return picture;
}

TEST(Resampler, IdentityChangesNoByte) {
  const tracking::Frame frame = waves();
  const engine::Image picture = pictureOf(frame);
  ASSERT_EQ(picture.rgba.size(), std::size_t{4} * kWidth * kHeight);
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_EQ(picture.rgba[i + c], frame.bgr[i / 4 * 3 + 2 - c]) << "red first";
    }
    ASSERT_EQ(picture.rgba[i + 3], 255);
  }
}

TEST(Resampler, EachColourHasAMapOfItsOwn) {
  const engine::Image picture = pictureOf(waves());
  const std::vector<engine::LookupMap> maps{mapOf(3), mapOf(0), mapOf(-200)};
  engine::Image result;
  Resampler{maps}(picture, result);
  for (std::size_t x = 0; x < kWidth - 4; ++x) {
    EXPECT_EQ(result.rgba[4 * x], picture.rgba[4 * (x + 3)]);
    EXPECT_EQ(result.rgba[4 * x + 1], picture.rgba[4 * x + 1]);
    EXPECT_EQ(result.rgba[4 * x + 2], 0) << "black where the map leaves the picture";
    EXPECT_EQ(result.rgba[4 * x + 3], 255);
  }
  EXPECT_THROW(Resampler(std::span(maps).first(2)), std::invalid_argument);
  EXPECT_THROW(Resampler{maps}(waves(), result), std::logic_error);
}

tracking::Rig rigWith(const tracking::DisplayLens& lens) {
  tracking::Rig rig = tracking::guessedRig(kWidth, kHeight, 2);
  for (tracking::RigCamera& camera : rig.cameras) camera.display = lens;
  return rig;
}

/// Greatest difference of a channel, and the part of the channels that differ by more than 3.
struct Difference {
  int greatest = 0;
  double beyond = 0;
};

/// Of a StereoPicture's left half from the engine's own lens pass.
Difference fromDevice(const tracking::DisplayLens& worn, const engine::Lens& device_lens) {
  const auto gpu = std::make_shared<engine::Gpu>();
  StereoPicture picture(gpu, rigWith(worn), {});
  picture.takeFrames({{waves(), waves()}});
  const engine::Image& both = picture.draw({}, {});
  engine::Offscreen offscreen(gpu, kWidth, kHeight, 2);
  offscreen.wear(std::array{device_lens, device_lens});
  const engine::Image by_device = offscreen.draw(picture.views(), {}).front();
  Difference difference;
  for (std::size_t row = 0; row < kHeight; ++row) {
    for (std::size_t i = 0; i < std::size_t{4} * kWidth; ++i) {
      const int one = both.rgba[row * 8 * kWidth + i], other = by_device.rgba[row * 4 * kWidth + i];
      difference.greatest = std::max(difference.greatest, std::abs(one - other));
      difference.beyond += std::abs(one - other) > 3 ? 1.0 / by_device.rgba.size() : 0.0;
    }
  }
  return difference;
}

TEST(StereoPicture, LensesOnTheProcessorAreThoseOfTheDevice) {
  const tracking::DisplayLens lens{
      .centre = {0.52, 0.48}, .k = {0.2, 0.1, 0.0}, .zoom = 1.1, .colour_scale = {1.01, 1, 0.99}};
  const engine::Lens device{
      .centre = {0.52, 0.48}, .k = {0.2, 0.1, 0.0}, .scale = Eigen::Vector3d(0.99, 1, 1.01) / 1.1};
  // Where the picture ends, at the border of black, half a pixel's place decides.
  EXPECT_LT(fromDevice(lens, device).beyond, 0.01);
  EXPECT_GT(fromDevice({}, device).beyond, 0.3) << "no lens must be seen";
  EXPECT_EQ(fromDevice({}, {}).greatest, 0) << "a plain one changes no byte";
}

TEST(StereoPicture, SwapsEyesAndLeavesThoseWithoutAFrameBlack) {
  const auto gpu = std::make_shared<engine::Gpu>();
  const auto redOf = [&](bool swapped, std::size_t x) {
    StereoPicture picture(gpu, rigWith({}), {.swap_eyes = swapped});
    picture.takeFrames({{waves(), std::nullopt}});
    return picture.draw({}, {}).rgba[4 * x];
  };
  EXPECT_GT(redOf(false, 5), 0);
  EXPECT_EQ(redOf(false, kWidth + 5), 0);
  EXPECT_EQ(redOf(true, 5), 0);
  EXPECT_GT(redOf(true, kWidth + 5), 0);
}

}  // namespace
}  // namespace slamscope::apps
