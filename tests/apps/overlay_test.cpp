// SPDX-License-Identifier: MIT
#include "apps/lib/view/overlay.hpp"

#include <gtest/gtest.h>

namespace slamscope::apps {
namespace {

/// 3 m above the floor, looking straight down; 200 px a metre.
Overlay fromAbove() {
  Eigen::Isometry3d T_camera_map = Eigen::Isometry3d::Identity();
  T_camera_map.linear() = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  T_camera_map.translation() = Eigen::Vector3d(0.0, 0.0, 3.0);
  return {.camera = {.width = 1200, .height = 720, .fx = 600, .fy = 600, .cx = 599.5, .cy = 359.5},
          .T_camera_map = T_camera_map,
          .true_T_camera_map = T_camera_map,
          .map_scale = 1.0};
}

slam::Snapshot twoFeatures() {
  slam::Snapshot snapshot;
  snapshot.ids = {4, 9};
  snapshot.features = {{1.0, 0.5}, {50.0, 0.0}};
  snapshot.truth = slam::Truth{.ids = {4}, .features = {{1.0, 0.4}}};
  return snapshot;
}

TEST(Overlay, TipsAreThePixelsOfFeaturesInThePicture) {
  FrameReport frame;
  measureOverlay(fromAbove(), twoFeatures(), frame);
  ASSERT_EQ(frame.tips.size(), 1U);
  EXPECT_EQ(frame.tips[0].id, 4U);
  EXPECT_LT((frame.tips[0].px - Eigen::Vector2d(799.5, 259.5)).norm(), 1e-9);
}

TEST(Overlay, ErrorIsRegistrationAloneAndSlamErrorIsSlamAlone) {
  FrameReport frame;
  Overlay overlay = fromAbove();
  measureOverlay(overlay, twoFeatures(), frame);
  EXPECT_NEAR(frame.overlay_errors_px.at(0), 0.0, 1e-12);
  EXPECT_NEAR(frame.slam_error_m.value(), 0.1, 1e-12);

  // 5 mm of registration error are one pixel, and leave SLAM's error alone.
  FrameReport shifted;
  overlay.T_camera_map.translation().x() += 0.005;
  measureOverlay(overlay, twoFeatures(), shifted);
  EXPECT_NEAR(shifted.overlay_errors_px.at(0), 1.0, 1e-9);
  EXPECT_NEAR(shifted.slam_error_m.value(), 0.1, 1e-12);
}

TEST(Overlay, WithoutTruthThereIsNothingToCompareWith) {
  FrameReport frame;
  Overlay overlay = fromAbove();
  overlay.true_T_camera_map.reset();
  slam::Snapshot snapshot = twoFeatures();
  snapshot.truth.reset();
  measureOverlay(overlay, snapshot, frame);
  EXPECT_EQ(frame.tips.size(), 1U);
  EXPECT_TRUE(frame.overlay_errors_px.empty());
  EXPECT_FALSE(frame.slam_error_m.has_value());
}

}  // namespace
}  // namespace slamscope::apps
