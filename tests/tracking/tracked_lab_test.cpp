// SPDX-License-Identifier: MIT
// From the lab's pixels to the map's place: the lab shares no projection code with what is tested
// here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tracking/lab.hpp"
#include "tracking/registration.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::AngleAxisd, Eigen::Isometry3d, Eigen::Translation3d, Eigen::Vector3d;

/// One lab, detected once; what differs is what is known beforehand.
class TrackedLab : public ::testing::Test {
 protected:
  static constexpr int kFrames = 10;
  static void SetUpTestSuite() {
    LabOptions options = defaultLab();
    options.T_world_map = Translation3d(0.2, -0.3, 0) * AngleAxisd(0.4, Vector3d::UnitZ());
    const Lab lab(options);
    options_ = new LabOptions(lab.options());
    TagDetector detector({.camera = CameraModel(options.camera)});
    frames_ = new std::vector<std::vector<TagDetection>>;
    for (int k = 0; k < kFrames; ++k) {
      frames_->push_back(detector.detect(lab.frame(static_cast<std::uint64_t>(k))));
    }
  }
  static void TearDownTestSuite() {
    delete options_;
    delete frames_;
  }

  static RegistrationOptions known() {
    RegistrationOptions options;
    options.frames = kFrames;
    options.robot->id = options_->robot_tag_id;
    options.robot->size_m = options_->robot_tag_size;
    options.robot->T_robot_tag = options_->T_robot_tag;
    return options;
  }
  static TagLayout floor() {
    TagLayout layout;
    for (const LabTag& tag : options_->tags)
      layout.tags.push_back({tag.id, tag.size, tag.T_world_tag});
    return layout;
  }

  /// 95th percentile over the 3 m × 3 m floor; `shift_px` is added to every corner.
  static double overlayP95(const RegistrationOptions& options, double shift_px = 0) {
    const CameraModel camera(options_->camera);
    Registration registration(options, camera);
    for (int k = 0; k < kFrames; ++k) {
      auto tags = (*frames_)[static_cast<std::size_t>(k)];
      for (TagDetection& tag : tags) {
        for (auto& corner : tag.corners_px) corner.array() += shift_px;
      }
      registration.add(std::chrono::milliseconds(33 * k), tags);
    }
    if (!registration.result()) return 1e9;
    EXPECT_TRUE(registration.problems().empty()) << registration.problems()[0];
    const Isometry3d T_camera_map = options_->T_world_camera.inverse() * options_->T_world_map;
    std::vector<double> errors;
    for (double x = -1.5; x < 1.51; x += 0.1) {
      for (double y = -1.5; y < 1.51; y += 0.1) {
        const Vector3d p(x, y, 0);
        const auto truth = camera.project(T_camera_map * p);
        const auto drawn = camera.project(registration.result()->T_camera_map * p);
        if (truth && drawn) errors.push_back((*truth - *drawn).norm());
      }
    }
    std::sort(errors.begin(), errors.end());
    return errors[errors.size() * 95 / 100];
  }

  static inline LabOptions* options_ = nullptr;
  static inline std::vector<std::vector<TagDetection>>* frames_ = nullptr;
};

TEST_F(TrackedLab, AllTagsAreSeenInEveryFrame) {
  for (const auto& tags : *frames_) EXPECT_EQ(tags.size(), 9U);
}

TEST_F(TrackedLab, OverlayByFloorTagsIsWithinAFewHundredthsOfAPixel) {
  RegistrationOptions options = known();
  options.layout = floor();
  EXPECT_LT(overlayP95(options), 0.05);  // figure T3: 0.5, aim 0.15
}

TEST_F(TrackedLab, OverlayByAGivenPoseIsToo) {
  RegistrationOptions options = known();
  options.camera_pose = CameraPose{options_->T_world_camera.inverse()};
  EXPECT_LT(overlayP95(options), 0.05);
  EXPECT_GT(overlayP95(options, 0.5), 0.3) << "half a pixel must be seen";
}

TEST_F(TrackedLab, FollowedFrameByFrameItStays) {
  RegistrationOptions options = known();
  options.layout = floor();
  options.continuous = true;
  EXPECT_LT(overlayP95(options), 0.1);
}

}  // namespace
}  // namespace slamscope::tracking
