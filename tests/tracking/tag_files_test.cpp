// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>

#include "tracking/robot_tag.hpp"
#include "tracking/tag_layout.hpp"

namespace slamscope::tracking {
namespace {

class TagFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    file_ =
        std::filesystem::temp_directory_path() /
        ("slamscope_" +
         std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".yaml");
  }
  void TearDown() override { std::filesystem::remove(file_); }
  const std::filesystem::path& file(const std::string& text) {
    std::ofstream(file_) << text;
    return file_;
  }
  static std::string complaint(const std::function<void()>& read) {
    try {
      read();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  std::filesystem::path file_;
};

TEST_F(TagFiles, LayoutTakesEveryFormOfPose) {
  const TagLayout layout = readTagLayout(
      file("size_m: 0.16\ntags:\n"
           "  - {id: 1, T_world_tag: {position_m: [-1, -1, 0], rpy_deg: [0, 0, 90]}}\n"
           "  - {id: 2, size_m: 0.2, T_world_tag: {position_m: [1, 1, 0], "
           "quaternion_xyzw: [0, 0, 0.7071067811865476, 0.7071067811865476]}}\n"
           "  - {id: 3, T_world_tag: [[0, -1, 0, 2], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}\n"
           "  - {id: 4, position_m: [0, 2, 0]}\n"));
  ASSERT_EQ(layout.tags.size(), 4U);
  EXPECT_EQ(layout.family, "36h11");
  EXPECT_EQ(layout.find(2)->size_m, 0.2);
  EXPECT_EQ(layout.find(3)->size_m, 0.16);
  EXPECT_EQ(layout.find(9), nullptr);
  const Eigen::Vector3d right(1, 0, 0);
  for (const int id : {1, 2, 3}) {  // all three turned by 90 degrees about z
    EXPECT_LT((layout.find(id)->T_world_tag.linear() * right - Eigen::Vector3d(0, 1, 0)).norm(),
              1e-12);
  }
  EXPECT_TRUE(layout.find(4)->T_world_tag.linear().isIdentity());
}

TEST_F(TagFiles, LayoutComesBackToTheLastDigit) {
  TagLayout layout;
  layout.family = "25h9";
  MappedTag tag{7, 0.1234567890123456, Eigen::Isometry3d::Identity()};
  tag.T_world_tag.linear() =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  tag.T_world_tag.translation() << 1.0 / 3, -2.0 / 7, 0.1;
  layout.tags = {tag};
  writeTagLayout(layout, file_);
  const TagLayout back = readTagLayout(file_);
  EXPECT_EQ(back.family, "25h9");
  EXPECT_EQ(back.tags[0].size_m, tag.size_m);
  EXPECT_TRUE(back.tags[0].T_world_tag.isApprox(tag.T_world_tag, 1e-15));
}

TEST_F(TagFiles, LayoutComplaintsNameTagAndField) {
  const auto read = [&](const std::string& text) {
    return complaint([&] { static_cast<void>(readTagLayout(file(text))); });
  };
  EXPECT_NE(read("tags: []").find("at least one tag"), std::string::npos);
  EXPECT_NE(read("family: 36h11").find("expected the field tags"), std::string::npos);
  EXPECT_NE(
      read("tags: [{id: 1, position_m: [0, 0, 0]}]").find("tags[0]: expected the field size_m"),
      std::string::npos);
  EXPECT_NE(
      read("size_m: 0.1\ntags: [{id: 1, position_m: [0, 0, 0]}, {id: 1, position_m: [1, 0, 0]}]")
          .find("given twice"),
      std::string::npos);
  EXPECT_NE(read("size_m: 0.1\ntags: [{id: 1, positon_m: [0, 0, 0]}]").find("positon_m is unknown"),
            std::string::npos);
  EXPECT_NE(read("size_m: -1\ntags: [{id: 1, position_m: [0, 0, 0]}]")
                .find("size_m: expected a positive"),
            std::string::npos);
  EXPECT_NE(
      read("size_m: 1\ntags: [{id: 1, T_world_tag: [[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}]")
          .find("tags[0].T_world_tag: expected 4 rows of 4 numbers"),
      std::string::npos);
}

TEST_F(TagFiles, RobotTagHasDefaultsAndReads) {
  const RobotTag defaults = readRobotTag(file("id: 5"));
  EXPECT_EQ(defaults.id, 5);
  EXPECT_EQ(defaults.size_m, 0.20);
  EXPECT_EQ(defaults.T_robot_tag.translation().z(), 0.20);
  const RobotTag tag = readRobotTag(
      file("id: 3\nsize_m: 0.1\nT_robot_tag: {position_m: [0.1, 0, 0.4], rpy_deg: [0, 90, 0]}"));
  EXPECT_NEAR(tag.T_robot_tag.linear()(0, 2), 1, 1e-12) << "z of the tag looks forward";
  const std::string message =
      complaint([&] { static_cast<void>(readRobotTag(file("id: 3\nheight: 1"))); });
  EXPECT_NE(message.find("height is unknown"), std::string::npos) << message;
  EXPECT_NE(complaint([&] { static_cast<void>(readRobotTag(file("id: -3"))); }).find("id"),
            std::string::npos);
}

TEST_F(TagFiles, CameraPoseIsReadEitherWay) {
  const CameraPose down = readCameraPose(file(
      "T_world_camera: {position_m: [0, 0, 3], rpy_deg: [180, 0, 0]}\nsigma_rotation_deg: 0.9"));
  const Eigen::Vector3d floor = down.T_camera_world * Eigen::Vector3d(1, 0.5, 0);
  EXPECT_LT((floor - Eigen::Vector3d(1, -0.5, 3)).norm(), 1e-12);
  EXPECT_NEAR(down.sigma_rotation_rad, 0.9 * std::numbers::pi / 180, 1e-15);
  writeCameraPose(down, file_);
  EXPECT_TRUE(readCameraPose(file_).T_camera_world.isApprox(down.T_camera_world, 1e-15));
  const CameraPose other =
      readCameraPose(file("T_camera_world: [1,0,0,0, 0,-1,0,0, 0,0,-1,3, 0,0,0,1]"));
  EXPECT_TRUE(other.T_camera_world.isApprox(down.T_camera_world, 1e-12));
  EXPECT_NE(complaint([&] {
              static_cast<void>(readCameraPose(file("sigma_position_m: 1")));
            }).find("either T_world_camera or T_camera_world"),
            std::string::npos);
}

}  // namespace
}  // namespace slamscope::tracking
