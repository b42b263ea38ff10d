// SPDX-License-Identifier: MIT
#include "engine/window/letterbox.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

using namespace slamscope::engine;
using Eigen::Vector2d;
using Eigen::Vector2i;

TEST(Letterbox, PictureOfTheWindowsSizeIsExact) {
  const Letterbox box = letterbox({1280, 720}, 1, {1280, 720});
  EXPECT_TRUE(box.exact);
  EXPECT_EQ(box.corner_px, Vector2i(0, 0));
  EXPECT_EQ(box.size_px, Vector2i(1280, 720));
  EXPECT_FALSE(letterbox({1280, 720}, 1, {1281, 722}).exact);
}

TEST(Letterbox, ShapeIsKeptInTheMiddle) {
  const Letterbox wide = letterbox({640, 480}, 1, {1000, 480});
  EXPECT_EQ(wide.corner_px, Vector2i(180, 0));
  EXPECT_EQ(wide.size_px, Vector2i(640, 480));
  EXPECT_TRUE(wide.exact);
  const Letterbox tall = letterbox({640, 480}, 1, {320, 1000});
  EXPECT_EQ(tall.size_px, Vector2i(320, 240));
  EXPECT_EQ(tall.corner_px, Vector2i(0, 380));
  const Letterbox pair = letterbox({640, 480}, 2, {640, 480});
  EXPECT_EQ(pair.size_px, Vector2i(640, 240));
}

TEST(Letterbox, NeverEmptyNorPastTheWindow) {
  for (const Vector2i& window :
       {Vector2i(1, 1), Vector2i(1, 2000), Vector2i(2000, 1), Vector2i(37, 91)}) {
    const Letterbox box = letterbox({1280, 720}, 2, window);
    EXPECT_GE(box.size_px.minCoeff(), 1);
    EXPECT_GE(box.corner_px.minCoeff(), 0);
    EXPECT_GE((window - box.corner_px - box.size_px).minCoeff(), 0);
  }
  EXPECT_THROW((void)letterbox({1280, 720}, 1, {0, 5}), std::invalid_argument);
}

TEST(Letterbox, PointsOfTheWindowAreFoundInThePicture) {
  const Vector2i picture(640, 480);
  const Letterbox box = letterbox(picture, 2, {2560, 1100});  // twice as large, 70 px above
  ASSERT_EQ(box.corner_px, Vector2i(0, 70));
  // The middle of a pixel that is shown as 2 × 2 is its lower right one's corner.
  const auto first = pictureAt(box, picture, 2, Vector2d(2 * 10 + 1, 70 + 2 * 20 + 1));
  ASSERT_TRUE(first);
  EXPECT_EQ(first->view, 0);
  EXPECT_LT((first->px - Vector2d(10, 20)).norm(), 1e-9);
  const auto second = pictureAt(box, picture, 2, Vector2d(1280 + 2 * 10 + 1, 70 + 2 * 20 + 1));
  ASSERT_TRUE(second);
  EXPECT_EQ(second->view, 1);
  EXPECT_LT((second->px - Vector2d(10, 20)).norm(), 1e-9);
  EXPECT_FALSE(pictureAt(box, picture, 2, Vector2d(100, 69.9)));
  EXPECT_FALSE(pictureAt(box, picture, 2, Vector2d(100, 1030)));
}
