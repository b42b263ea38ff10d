// SPDX-License-Identifier: MIT
#include "apps/lib/view/eye_layout.hpp"

#include <gtest/gtest.h>

#include "apps/lib/view/latency_log.hpp"

namespace slamscope::apps {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// 2 × 2, each pixel's channels told apart.
engine::Image eye(std::uint8_t first) {
  engine::Image picture{2, 2, {}};
  for (std::uint8_t i = 0; i < 16; ++i) {
    picture.rgba.push_back(static_cast<std::uint8_t>(first + i));
  }
  return picture;
}

engine::Image laidOut(EyeLayout layout) {
  engine::Image both;
  layOut(layout, eye(0), eye(100), both);
  return both;
}

TEST(EyeLayout, SideBySideHasTheLeftEyeAtTheLeft) {
  const engine::Image both = laidOut(EyeLayout::side_by_side);
  EXPECT_EQ(both.width, 4);
  EXPECT_EQ(both.height, 2);
  const Bytes row(both.rgba.begin(), both.rgba.begin() + 16);
  EXPECT_EQ(row, (Bytes{0, 1, 2, 3, 4, 5, 6, 7, 100, 101, 102, 103, 104, 105, 106, 107}));
}

TEST(EyeLayout, HalfSideBySideAveragesColumnsInPairs) {
  const engine::Image both = laidOut(EyeLayout::half_side_by_side);
  EXPECT_EQ(both.width, 2);
  EXPECT_EQ(both.rgba, (Bytes{2, 3, 4, 5, 102, 103, 104, 105, 10, 11, 12, 13, 110, 111, 112, 113}));
}

TEST(EyeLayout, TopBottomHasTheLeftEyeAbove) {
  const engine::Image both = laidOut(EyeLayout::top_bottom);
  EXPECT_EQ(both.height, 4);
  EXPECT_EQ(both.rgba[15], 15);
  EXPECT_EQ(both.rgba[16], 100);
}

TEST(EyeLayout, AnaglyphTakesRedFromTheLeftEye) {
  const engine::Image both = laidOut(EyeLayout::anaglyph);
  EXPECT_EQ(both.width, 2);
  EXPECT_EQ(Bytes(both.rgba.begin(), both.rgba.begin() + 8),
            (Bytes{0, 101, 102, 103, 4, 105, 106, 107}));
}

TEST(EyeLayout, RefusesUnknownNamesAndUnequalEyes) {
  EXPECT_EQ(eyeLayoutFromName("top-bottom"), EyeLayout::top_bottom);
  EXPECT_THROW((void)eyeLayoutFromName("cross-eyed"), std::invalid_argument);
  engine::Image both;
  EXPECT_THROW(layOut(EyeLayout::anaglyph, eye(0), {4, 1, Bytes(16)}, both), std::invalid_argument);
  const engine::Image odd{1, 1, Bytes(4)};
  EXPECT_THROW(layOut(EyeLayout::half_side_by_side, odd, odd, both), std::invalid_argument);
}

TEST(EyeLayout, APixelOfBothIsThatOfTheEyeThatWasLaidThere) {
  for (const EyeLayout layout :
       {EyeLayout::side_by_side, EyeLayout::top_bottom, EyeLayout::anaglyph}) {
    const engine::Image both = laidOut(layout);
    for (int v = 0; v < both.height; ++v) {
      for (int u = 0; u < both.width; ++u) {
        const EyePixel seen = eyePixel(layout, {2, 2}, {u, v});
        const Eigen::Vector2i pixel = seen.pixel.cast<int>();
        const int expected = 100 * seen.eye + 4 * (2 * pixel.y() + pixel.x());
        EXPECT_EQ(both.rgba[4 * std::size_t(both.width * v + u)], expected);
        // Twin: the other eye has another.
        EXPECT_NE(both.rgba[4 * std::size_t(both.width * v + u)], 100 - expected);
      }
    }
  }
  // Half as wide, a pixel is in the middle between two.
  EXPECT_EQ(eyePixel(EyeLayout::half_side_by_side, {8, 2}, {3.0, 1.0}).pixel.x(), 6.5);
  const EyePixel right = eyePixel(EyeLayout::half_side_by_side, {8, 2}, {5.0, 1.0});
  EXPECT_EQ(right.eye, 1);
  EXPECT_EQ(right.pixel.x(), 2.5);
}

TEST(Latency, IsWholeOnlyWhereTheCameraStampsByTheSteadyClock) {
  using std::chrono::milliseconds;
  const std::chrono::steady_clock::time_point dequeued{milliseconds(1'000'020)};
  FrameStations stations{.mid_exposure = milliseconds(1'000'000),
                         .dequeued = dequeued,
                         .pose = dequeued + milliseconds(10),
                         .presented = dequeued + milliseconds(30)};
  EXPECT_DOUBLE_EQ(softwareLatencyMs(stations), 30.0);
  EXPECT_DOUBLE_EQ(wholeLatencyMs(stations).value(), 50.0);
  stations.mid_exposure = milliseconds(40);
  EXPECT_FALSE(wholeLatencyMs(stations));
}

}  // namespace
}  // namespace slamscope::apps
