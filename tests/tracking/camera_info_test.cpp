// SPDX-License-Identifier: MIT
#include "tracking/camera_info.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace slamscope::tracking {
namespace {

class CameraInfoFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("slamscope_camera_info_" +
               std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
    file_ = folder_ / "camera.yaml";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string complaint(const std::string& text) {
    std::ofstream(file_) << text;
    try {
      static_cast<void>(readCameraInfo(file_));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_, file_;
};

const std::string kGood =
    "image_width: 640\nimage_height: 480\ncamera_name: narrow\n"
    "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [600, 0, 319.5, 0, 610, 239.5, 0, 0, 1]\n"
    "distortion_model: plumb_bob\n"
    "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [-0.2, 0.1, 0.001, -0.002, 0]\n";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kGood;
  return text.replace(text.find(from), from.size(), to);
}

TEST_F(CameraInfoFile, ReadsWhatRosWrites) {
  ASSERT_EQ(complaint(kGood), "");
  const CameraInfo info = readCameraInfo(file_);
  EXPECT_EQ(info.name, "narrow");
  EXPECT_EQ(info.width, 640);
  EXPECT_EQ(info.height, 480);
  EXPECT_EQ(info.K(1, 1), 610);
  EXPECT_EQ(info.K(0, 2), 319.5);
  EXPECT_EQ(info.D, (std::vector<double>{-0.2, 0.1, 0.001, -0.002, 0}));
}

TEST_F(CameraInfoFile, ComesBackToTheLastDigit) {
  CameraInfo info;
  info.name = "wide: \"left\"";
  info.width = 1280;
  info.height = 720;
  info.K << 1000.0 / 3, 0.1, 639.123456789012345, 0, 333.3, 359.5, 0, 0, 1;
  info.model = DistortionModel::equidistant;
  info.D = {1e-17, -1.0 / 7, 0.1, 0};
  writeCameraInfo(info, file_);
  const CameraInfo back = readCameraInfo(file_);
  EXPECT_EQ(back.name, info.name);
  EXPECT_EQ(back.K, info.K);
  EXPECT_EQ(back.D, info.D);
  EXPECT_EQ(back.model, info.model);
}

TEST_F(CameraInfoFile, ComplaintsNameFileFieldAndExpectation) {
  const auto expect = [&](const std::string& text, const std::string& field,
                          const std::string& expectation) {
    const std::string message = complaint(text);
    EXPECT_NE(message.find("camera.yaml"), std::string::npos) << message;
    EXPECT_NE(message.find(field), std::string::npos) << message;
    EXPECT_NE(message.find(expectation), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  };
  expect(with("image_width: 640", "image_width: wide"), "image_width", "whole number");
  expect(with("image_width: 640", "image_width: 0"), "image_width", "positive");
  expect(with("image_height: 480\n", ""), "image_height", "expected the field");
  expect(with("[600, 0, 319.5, 0, 610, 239.5, 0, 0, 1]", "[600, 0, 319.5]"), "camera_matrix.data",
         "9 numbers");
  expect(with("[600, 0", "[-600, 0"), "camera_matrix.data", "positive fx");
  expect(with("[600, 0", "[x, 0"), "camera_matrix.data", "expected a number");
  expect(with("[600, 0", "[.nan, 0"), "camera_matrix.data", "expected a number");
  expect(with("plumb_bob", "plumb"), "distortion_model", "expected plumb_bob");
  expect(with("-0.002, 0]", "-0.002, 0, 1]"), "distortion_coefficients.data", "4 or 5");
  expect("[1, 2]", "", "expected a YAML map");
  expect("a: [1", "line", "expected YAML");
}

TEST_F(CameraInfoFile, MissingFileIsNamed) {
  EXPECT_THROW(static_cast<void>(readCameraInfo(folder_ / "none.yaml")), std::runtime_error);
}

TEST(CameraInfo, SizeMismatchNamesBothSizes) {
  CameraInfo info;
  info.width = 640;
  info.height = 480;
  EXPECT_NO_THROW(requireSize(info, 640, 480));
  try {
    requireSize(info, 1280, 720);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "camera info is for 640 x 480, the frames are 1280 x 720");
  }
}

TEST(CameraInfo, ScaledPinholeKeepsTheOuterCorners) {
  CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.K << 600, 3, 300, 0, 610, 250, 0, 0, 1;
  info.D = {-0.1, 0, 0, 0};
  const CameraInfo twice = idealPinhole(info, 1280, 960);
  EXPECT_TRUE(twice.D.empty());
  EXPECT_EQ(twice.K(0, 1), 0);
  // The left edge of the picture (u = −0.5) is the same ray in both.
  EXPECT_DOUBLE_EQ((-0.5 - twice.K(0, 2)) / twice.K(0, 0), (-0.5 - 300) / 600.0);
  EXPECT_DOUBLE_EQ((959.5 - twice.K(1, 2)) / twice.K(1, 1), (479.5 - 250) / 610.0);
  // A wider shape cuts above and below alike.
  const CameraInfo wide = idealPinhole(info, 640, 360);
  EXPECT_DOUBLE_EQ(wide.K(0, 2), 300);
  EXPECT_DOUBLE_EQ(wide.K(1, 2), 250 - 60);
}

}  // namespace
}  // namespace slamscope::tracking
