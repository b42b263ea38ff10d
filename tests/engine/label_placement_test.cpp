// SPDX-License-Identifier: MIT
#include "engine/scene/label_placement.hpp"

#include <gtest/gtest.h>

#include <random>

using namespace slamscope::engine;

namespace {

struct Crowd {
  std::vector<LabelRequest> labels;
  std::vector<PixelBox> obstacles;
};

Crowd crowd(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(60.0, 580.0);
  Crowd made;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d anchor(place(random), place(random));
    made.labels.push_back({anchor, {24.0, 16.0}, {}});
    // A cone stands on its tip: the box above the anchor.
    made.obstacles.push_back({anchor - Eigen::Vector2d(8, 20), anchor + Eigen::Vector2d(8, 0)});
  }
  return made;
}

std::vector<PixelBox> boxesOf(const std::vector<LabelRequest>& labels,
                              const std::vector<std::optional<Eigen::Vector2d>>& offsets) {
  std::vector<PixelBox> boxes;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (!offsets[i]) continue;
    const Eigen::Vector2d centre = labels[i].anchor_px + *offsets[i];
    boxes.push_back({centre - 0.5 * labels[i].size_px, centre + 0.5 * labels[i].size_px});
  }
  return boxes;
}

int overlaps(const std::vector<PixelBox>& boxes, const std::vector<PixelBox>& obstacles) {
  int count = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) count += overlap(boxes[i], boxes[j]) ? 1 : 0;
    for (const PixelBox& obstacle : obstacles) count += overlap(boxes[i], obstacle) ? 1 : 0;
  }
  return count;
}

}  // namespace

TEST(LabelPlacement, NoLabelCoversAnotherNorAnObstacle) {
  const Crowd made = crowd(60);
  const auto offsets = placeLabels(made.labels, made.obstacles, {});
  const auto boxes = boxesOf(made.labels, offsets);
  EXPECT_EQ(overlaps(boxes, made.obstacles), 0);
  EXPECT_GE(boxes.size(), 55u);  // there is room for nearly all

  // Twin: every label right below its anchor does collide, so the count can tell.
  const std::vector<std::optional<Eigen::Vector2d>> naive(made.labels.size(),
                                                          Eigen::Vector2d(0, 14));
  EXPECT_GT(overlaps(boxesOf(made.labels, naive), made.obstacles), 0);
}

TEST(LabelPlacement, AloneALabelStandsBelowItsAnchorByTheGap) {
  const LabelRequest label{{100, 100}, {20, 10}, {}};
  const auto offsets = placeLabels({&label, 1}, {}, {.gap_px = 4});
  ASSERT_TRUE(offsets[0]);
  EXPECT_EQ(*offsets[0], Eigen::Vector2d(0, 9));
}

TEST(LabelPlacement, StaysInsideThePicture) {
  const LabelRequest label{{100, 478}, {20, 10}, {}};
  const auto offsets = placeLabels({&label, 1}, {}, {.picture = {{0, 0}, {640, 480}}});
  ASSERT_TRUE(offsets[0]);
  EXPECT_LT(offsets[0]->y(), 0.0);
}

TEST(LabelPlacement, KeepsLastPlaceWhileItIsFree) {
  LabelRequest label{{100, 100}, {20, 10}, Eigen::Vector2d(16, -11)};
  EXPECT_EQ(*placeLabels({&label, 1}, {}, {})[0], Eigen::Vector2d(16, -11));
  const PixelBox taken{{100, 80}, {120, 95}};
  EXPECT_NE(*placeLabels({&label, 1}, {&taken, 1}, {})[0], Eigen::Vector2d(16, -11));
}

TEST(LabelPlacement, GivesNoneWhereEveryPlaceIsTaken) {
  const LabelRequest label{{100, 100}, {20, 10}, {}};
  const PixelBox everything{{0, 0}, {200, 200}};
  EXPECT_FALSE(placeLabels({&label, 1}, {&everything, 1}, {})[0]);
}

TEST(LabelPlacement, BoxesThatOnlyTouchDoNotOverlap) {
  EXPECT_FALSE(overlap({{0, 0}, {10, 10}}, {{10, 0}, {20, 10}}));
  EXPECT_TRUE(overlap({{0, 0}, {10, 10}}, {{9.9, 9.9}, {20, 20}}));
}
