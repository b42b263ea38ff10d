// SPDX-License-Identifier: MIT
#include "tracking/tag_pose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "seen_tags.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::AngleAxisd, Eigen::Isometry3d, Eigen::Translation3d, Eigen::Vector3d;
using testing::floorTags, testing::lookingDown, testing::overheadCamera, testing::perturbation,
    testing::seeLayout;

Isometry3d askew() {
  Isometry3d T = lookingDown();
  T.linear() = AngleAxisd(0.12, Vector3d(1, 0.5, 0.2).normalized()) * T.linear();
  return T;
}

TEST(TagPose, IsExactWithoutNoise) {
  const CameraModel camera(overheadCamera());
  std::mt19937 random(1);
  for (const int tags : {1, 2, 4, 8}) {
    const TagLayout layout = floorTags(tags);
    auto seen = seeLayout(camera, layout, askew(), 1e-9, random);
    const auto pose = estimateTagPose(camera, layout, seen);
    ASSERT_TRUE(pose);
    EXPECT_LT(perturbation(askew(), pose->T_camera_world).norm(), 1e-6) << tags;
    EXPECT_EQ(pose->corners, 4 * tags);
    EXPECT_FALSE(pose->ambiguous);
  }
}

TEST(TagPose, ThroughALensToo) {
  CameraInfo info = overheadCamera();
  info.D = {-0.2, 0.06, 0.001, -0.0005, 0};
  const CameraModel camera(info);
  std::mt19937 random(1);
  const TagLayout layout = floorTags(4);
  const auto pose =
      estimateTagPose(camera, layout, seeLayout(camera, layout, askew(), 1e-9, random));
  ASSERT_TRUE(pose);
  EXPECT_LT(perturbation(askew(), pose->T_camera_world).norm(), 1e-6);
}

TEST(TagPose, NothingWithoutMappedTags) {
  const CameraModel camera(overheadCamera());
  std::mt19937 random(1);
  auto seen = seeLayout(camera, floorTags(2), askew(), 0.1, random);
  for (TagDetection& tag : seen) tag.id += 50;
  EXPECT_FALSE(estimateTagPose(camera, floorTags(2), seen));
  EXPECT_FALSE(estimateTagPose(camera, floorTags(2), {}));
}

/// Mean NEES of the pose over runs whose corners are noisier than stated by `factor`.
double meanNees(double factor, int runs) {
  const CameraModel camera(overheadCamera());
  const TagLayout layout = floorTags(4);
  std::mt19937 random(5);
  double sum = 0;
  for (int k = 0; k < runs; ++k) {
    auto seen = seeLayout(camera, layout, askew(), 0.1 * factor, random);
    for (TagDetection& tag : seen) tag.sigma_px.fill(0.1);
    const auto pose = estimateTagPose(camera, layout, seen);
    if (!pose) return 1e9;
    const auto d = perturbation(pose->T_camera_world, askew());
    sum += testing::nees(d, pose->covariance);
  }
  return sum / runs;
}

TEST(TagPose, CovarianceIsHonest) {
  constexpr int kRuns = 300;
  const testing::Band band = testing::neesBand(6, kRuns);
  const double nees = meanNees(1, kRuns);
  EXPECT_TRUE(band.holds(nees)) << nees;
  EXPECT_FALSE(band.holds(meanNees(1.25, kRuns))) << "noise a quarter larger than stated must show";
}

TEST(TagPose, CoveredCornerIsLeftOut) {
  const CameraModel camera(overheadCamera());
  const TagLayout layout = floorTags(4);
  std::mt19937 random(2);
  auto seen = seeLayout(camera, layout, askew(), 0.05, random);
  seen[1].corners_px[2] += Eigen::Vector2d(2, -2);  // 10 % of the side covered
  const auto pose = estimateTagPose(camera, layout, seen);
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->corners, 15);
  EXPECT_TRUE(pose->rejected_ids.empty());
  EXPECT_LT(pose->residual_px, 0.15);
}

TEST(TagPose, MovedDoubledOrWrongTagIsNamed) {
  const CameraModel camera(overheadCamera());
  const TagLayout layout = floorTags(4);
  std::mt19937 random(3);
  int named = 0;
  constexpr int kRuns = 50;
  for (int k = 0; k < kRuns; ++k) {
    TagLayout really = layout;
    if (k % 3 == 0) really.tags[2].T_world_tag.pretranslate(Vector3d(0.05, 0.02, 0));
    if (k % 3 == 1) really.tags[2].size_m = 0.18;
    if (k % 3 == 2) std::swap(really.tags[2].id, really.tags[3].id);
    const auto seen = seeLayout(camera, really, askew(), 0.1, random);
    const auto pose = estimateTagPose(camera, layout, seen);
    ASSERT_TRUE(pose);
    EXPECT_LT(perturbation(askew(), pose->T_camera_world).norm(), 0.02) << k;
    named += std::count(pose->rejected_ids.begin(), pose->rejected_ids.end(), 102);
  }
  EXPECT_EQ(named, kRuns);
  // The twin: nothing is named where nothing is wrong.
  const auto right =
      estimateTagPose(camera, layout, seeLayout(camera, layout, askew(), 0.1, random));
  EXPECT_TRUE(right->rejected_ids.empty());
}

TEST(TagPose, SingleFrontalTagIsAmbiguousAndAPriorDecides) {
  const CameraModel camera(overheadCamera());
  TagLayout layout = floorTags(1);
  layout.tags[0].T_world_tag = Isometry3d(Translation3d(0.2, 0.1, 0));
  Isometry3d T = lookingDown(4);
  T.linear() = AngleAxisd(0.05, Vector3d::UnitX()) * T.linear();
  std::mt19937 random(4);
  int ambiguous = 0, wrong = 0, wrong_with_prior = 0, undecided_with_prior = 0;
  constexpr int kRuns = 200;
  const auto turned = [&](const Isometry3d& estimate) {
    return perturbation(T, estimate).tail<3>().norm();
  };
  for (int k = 0; k < kRuns; ++k) {
    const auto seen = seeLayout(camera, layout, T, 0.15, random);
    const auto alone = estimateTagPose(camera, layout, seen);
    ASSERT_TRUE(alone);
    ambiguous += alone->ambiguous;
    const bool other_is_nearer =
        alone->other && turned(*alone->other) < turned(alone->T_camera_world);
    wrong += other_is_nearer;
    EXPECT_TRUE(!other_is_nearer || alone->ambiguous) << "a wrong branch must be called ambiguous";
    TagPoseOptions options;
    options.prior_T_camera_world = T;
    const auto with_prior = estimateTagPose(camera, layout, seen, options);
    ASSERT_TRUE(with_prior);
    const bool still_wrong =
        with_prior->other && turned(*with_prior->other) < turned(with_prior->T_camera_world);
    wrong_with_prior += still_wrong && !with_prior->ambiguous;
    undecided_with_prior += with_prior->ambiguous;
  }
  EXPECT_GT(ambiguous, kRuns / 2);
  EXPECT_GT(wrong, kRuns / 20) << "else this tests nothing";
  EXPECT_EQ(wrong_with_prior, 0);
  EXPECT_LT(undecided_with_prior, ambiguous);
}

TEST(TagPose, SecondTagSettlesTheAmbiguity) {
  const CameraModel camera(overheadCamera());
  const TagLayout layout = floorTags(4);
  std::mt19937 random(6);
  for (int k = 0; k < 50; ++k) {
    const auto pose =
        estimateTagPose(camera, layout, seeLayout(camera, layout, lookingDown(), 0.1, random));
    ASSERT_TRUE(pose);
    EXPECT_FALSE(pose->ambiguous);
    EXPECT_LT(perturbation(lookingDown(), pose->T_camera_world).norm(), 0.01);
  }
}

TEST(TagPose, TagsOnWallAndFloorWorkTogether) {
  const CameraModel camera(overheadCamera());
  TagLayout layout = floorTags(2);
  Isometry3d wall(Translation3d(0, 1.3, 0.5));
  wall.linear() = AngleAxisd(M_PI / 2, Vector3d::UnitX()).toRotationMatrix();  // looks towards −y
  layout.tags.push_back({7, 0.15, wall});
  Isometry3d T_world_camera(Translation3d(0.3, -3, 1.5));
  T_world_camera.linear() = AngleAxisd(-M_PI / 2 - 0.4, Vector3d::UnitX()).toRotationMatrix();
  const Isometry3d T = T_world_camera.inverse();
  std::mt19937 random(8);
  const auto pose = estimateTagPose(camera, layout, seeLayout(camera, layout, T, 1e-6, random));
  ASSERT_TRUE(pose);
  EXPECT_LT(perturbation(T, pose->T_camera_world).norm(), 1e-4);
}

}  // namespace
}  // namespace slamscope::tracking
