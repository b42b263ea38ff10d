// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tracking/lab.hpp"
#include "tracking/lab_lens.hpp"

namespace slamscope::tracking {
namespace {

using Json = nlohmann::json;

Eigen::Isometry3d pose(const Json& rows) {
  Eigen::Isometry3d T;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) T.matrix()(i, j) = rows.at(i).at(j);
  return T;
}

class LabTruth : public ::testing::Test {
 protected:
  LabTruth() {
    options_.posts = {{3, {1.0, 0.5}}, {9, {-0.25, 0.75}}};
    options_.T_world_map = Eigen::Translation3d(0.2, -0.1, 0) *
                           Eigen::Isometry3d(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
    writeLabTruth(options_, file_);
    std::ifstream(file_) >> truth_;
  }
  ~LabTruth() override { std::filesystem::remove(file_); }

  LabOptions options_ = defaultLab();
  std::filesystem::path file_ = std::filesystem::temp_directory_path() /
                                ("slamscope_lab_truth" + std::to_string(::getpid()) + ".json");
  Json truth_;
};

TEST_F(LabTruth, HasAllThatPixelsAreMadeOf) {
  EXPECT_EQ(truth_["image_size"], Json({1280, 720}));
  EXPECT_EQ(truth_["camera_matrix"][0][2], options_.camera.K(0, 2));
  EXPECT_EQ(truth_["distortion"]["model"], "plumb_bob");
  EXPECT_EQ(truth_["distortion"]["coefficients"], Json(options_.camera.D));
  EXPECT_TRUE(pose(truth_["T_camera_world"]).isApprox(options_.T_world_camera.inverse(), 1e-12));
  EXPECT_TRUE(pose(truth_["T_world_map"]).isApprox(options_.T_world_map, 1e-12));
  EXPECT_EQ(truth_["robot_tag"]["id"], 0);
  EXPECT_EQ(truth_["robot_tag"]["T_robot_tag"][2][3], 0.20);
  EXPECT_EQ(truth_["floor_tags"].size(), options_.tags.size());
}

TEST_F(LabTruth, FeaturesAgreeInMapAndWorld) {
  ASSERT_EQ(truth_["features"].size(), 2U);
  for (const Json& feature : truth_["features"]) {
    const Eigen::Vector3d p_map(feature["map"][0], feature["map"][1], 0);
    const Eigen::Vector3d p_world(feature["world"][0], feature["world"][1], 0);
    EXPECT_TRUE((options_.T_world_map * p_map).isApprox(p_world, 1e-12)) << feature;
  }
}

TEST_F(LabTruth, CornersOfATagStartAtItsLowerLeft) {
  const Json& tag = truth_["floor_tags"][0];
  const Eigen::Isometry3d T_world_tag = pose(tag["T_world_tag"]);
  const Json& corner = tag["corners_world"][0];
  const Eigen::Vector3d p(corner[0], corner[1], corner[2]);
  EXPECT_TRUE((T_world_tag.inverse() * p).isApprox(Eigen::Vector3d(-0.1, -0.1, 0), 1e-12));
}

TEST(LabTruthFile, SaysWhereItCantBeWritten) {
  try {
    writeLabTruth(defaultLab(), "/no/such/place/truth.json");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/no/such/place/truth.json"), std::string::npos);
  }
}

}  // namespace
}  // namespace slamscope::tracking
