// SPDX-License-Identifier: MIT
// Real and rendered pictures of tags, where they are at hand: see the data's own README for
// sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <sstream>

#include "tracking/registration.hpp"
#include "tracking/tag_detector.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Vector2d;
using GivenCorners = std::array<Vector2d, 4>;
namespace fs = std::filesystem;

std::optional<fs::path> recorded(const std::string& folder) {
  const char* given = std::getenv("SLAMSCOPE_DATA");
  const fs::path data = given ? fs::path(given) : fs::path(SLAMSCOPE_SOURCE_DIR) / "../shared/data";
  if (!fs::is_directory(data / folder)) return std::nullopt;
  return data / folder;
}

#define SLAMSCOPE_NEED(folder, name)                                                          \
  const auto folder = recorded(name);                                                         \
  if (!folder) {                                                                              \
    GTEST_SKIP() << "no recorded data: " name " is neither in $SLAMSCOPE_DATA nor beside it"; \
  }

std::vector<TagDetection> detect(TagDetector& detector, const fs::path& file) {
  const cv::Mat picture = cv::imread(file.string(), cv::IMREAD_COLOR);
  if (picture.empty()) throw std::runtime_error(file.string() + ": no picture");
  return detector.detect({picture.data, picture.cols, picture.rows, 3});
}

/// Root mean square per axis, over the tags that both know, after `offset` was added to the given
/// ones.
double rmsDifference(const std::vector<TagDetection>& found,
                     const std::map<int, GivenCorners>& given, const Vector2d& offset) {
  double sum = 0;
  int count = 0;
  for (const TagDetection& tag : found) {
    const auto at = given.find(tag.id);
    if (at == given.end()) continue;
    for (std::size_t i = 0; i < 4; ++i, ++count) {
      sum += (tag.corners_px[i] - at->second[i] - offset).squaredNorm() / 2;
    }
  }
  return std::sqrt(sum / count);
}

TEST(RecordedTags, RenderedPictureGivesTheCornersThatCameWithIt) {
  SLAMSCOPE_NEED(folder, "visp_rendered_640x480");
  std::map<int, GivenCorners> given;
  std::ifstream text(*folder / "corners_tag36_11.txt");
  for (int id = 0; text >> id;) {
    for (Vector2d& corner : given[id]) text >> corner.x() >> corner.y();
  }
  TagDetector detector;
  const auto tags = detect(detector, *folder / "tag36_11_640x480.png");
  ASSERT_EQ(tags.size(), 5U);
  const double difference = rmsDifference(tags, given, {-0.5, -0.5});
  EXPECT_LT(difference, 0.10);
  EXPECT_GT(rmsDifference(tags, given, {0, 0}), 0.4) << "half a pixel must be seen";
  RecordProperty("rms_px", std::to_string(difference));
}

Isometry3d poseOf(const nlohmann::json& rows) {
  Isometry3d T = Isometry3d::Identity();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c)
      T.matrix()(r, c) = rows[std::size_t(r)][std::size_t(c)].get<double>();
  }
  return T;
}

/// What ViSP found in the sequence, and the board by it: mean pose of each tag over all frames.
struct Sequence {
  std::vector<std::map<int, GivenCorners>> corners;
  std::vector<Isometry3d> T_camera_board;
  TagLayout board;
  CameraModel camera;

  explicit Sequence(const fs::path& folder) : camera(intrinsics(folder)) {
    const auto json = nlohmann::json::parse(std::ifstream(folder / "apriltag_data.json"));
    std::map<int, std::pair<Eigen::Vector3d, Eigen::Vector4d>> sums;
    std::map<int, int> counts;
    for (std::size_t k = 0; k < json["detections"].size(); ++k) {
      T_camera_board.push_back(poseOf(json["grid"][k]));
      corners.emplace_back();
      for (const auto& [name, tag] : json["detections"][k].items()) {
        const int id = std::stoi(name);
        for (std::size_t i = 0; i < 4; ++i) {
          const auto& row_column = tag["tag_corners"][i];
          corners.back()[id][i] =
              Vector2d(row_column[1].get<double>(), row_column[0].get<double>());
        }
        const Isometry3d T_board_tag = T_camera_board.back().inverse() * poseOf(tag["cMo"]);
        Eigen::Vector4d q = Eigen::Quaterniond(T_board_tag.linear()).coeffs();
        auto& [place, turn] =
            sums.try_emplace(id, Eigen::Vector3d::Zero(), Eigen::Vector4d::Zero()).first->second;
        place += T_board_tag.translation();
        turn += q.dot(turn) < 0 ? Eigen::Vector4d(-q) : q;
        ++counts[id];
      }
    }
    for (const auto& [id, sum] : sums) {
      MappedTag tag{id, json["tag_size"], Isometry3d::Identity()};
      tag.T_world_tag.translation() = sum.first / counts[id];
      tag.T_world_tag.linear() =
          Eigen::Quaterniond(Eigen::Vector4d(sum.second.normalized())).matrix();
      board.tags.push_back(tag);
    }
  }

  static CameraInfo intrinsics(const fs::path& folder) {
    const auto json = nlohmann::json::parse(std::ifstream(folder / "cam.json"));
    CameraInfo info;
    info.width = json["w"];
    info.height = json["h"];
    info.K(0, 0) = json["px"];
    info.K(1, 1) = json["py"];
    info.K(0, 2) = json["u0"];
    info.K(1, 2) = json["v0"];
    return info;
  }

  static std::string picture(std::size_t k) {
    std::string number = std::to_string(k);
    return "color_image_" + std::string(4 - number.size(), '0') + number + ".png";
  }
};

TEST(RecordedTags, RealCameraOverABoardIsRegisteredInEveryFrame) {
  SLAMSCOPE_NEED(folder, "visp_sequence");
  const Sequence sequence(*folder);
  TagDetector detector;
  RegistrationOptions options;
  options.robot.reset();
  options.layout = sequence.board;
  options.continuous = true;
  options.extent_m = 0.5;
  Registration registration(options, sequence.camera);
  double residual2 = 0, corners2 = 0, unshifted2 = 0, jump = 0;
  std::optional<Isometry3d> before;
  ASSERT_EQ(sequence.corners.size(), 50U);
  for (std::size_t k = 0; k < 50; ++k) {
    const auto tags = detect(detector, *folder / Sequence::picture(k));
    for (const auto& [id, corners] : sequence.corners[k]) {
      EXPECT_TRUE(std::any_of(tags.begin(), tags.end(), [&](const auto& t) { return t.id == id; }))
          << "tag " << id << " in frame " << k;
    }
    // Given with the origin at a pixel's corner.
    corners2 += std::pow(rmsDifference(tags, sequence.corners[k], {-0.5, -0.5}), 2) / 50;
    unshifted2 += std::pow(rmsDifference(tags, sequence.corners[k], {0, 0}), 2) / 50;
    registration.add(std::chrono::milliseconds(33 * k), tags);
    ASSERT_EQ(registration.state(), RegistrationState::registered) << k << registration.status();
    const RegistrationResult& result = *registration.result();
    residual2 += result.residual_px * result.residual_px / 50;
    const Isometry3d off = sequence.T_camera_board[k].inverse() * result.T_camera_map;
    EXPECT_LT(off.translation().norm(), 0.02) << k;
    if (before)
      jump = std::max(jump, (before->inverse() * result.T_camera_map).translation().norm());
    before = result.T_camera_map;
  }
  RecordProperty("residual_px", std::to_string(std::sqrt(residual2)));
  RecordProperty("corners_against_visp_px", std::to_string(std::sqrt(corners2)));
  EXPECT_LT(std::sqrt(residual2), 0.8)
      << "the board is only known as well as ViSP's single tags are";
  EXPECT_LT(std::sqrt(corners2), 0.15);
  EXPECT_GT(std::sqrt(unshifted2), 0.4) << "half a pixel must be seen";
  EXPECT_LT(jump, 0.1) << "metres between frames of a camera moved by hand";
}

TEST(RecordedTags, PhotographsGiveTheTagsThatCameWithThem) {
  SLAMSCOPE_NEED(folder, "apriltag_photos");
  for (const char* name : {"33369213973_9d9bb4cc96_c", "34085369442_304b6bafd9_c"}) {
    TagDetector detector;
    const auto tags = detect(detector, *folder / (std::string(name) + ".jpg"));
    std::ifstream text(*folder / (std::string(name) + ".txt"));
    std::string line;
    int given = 0, found = 0;
    double sum = 0;
    while (std::getline(text, line)) {
      std::replace_if(
          line.begin(), line.end(), [](char c) { return c == ',' || c == '(' || c == ')'; }, ' ');
      std::istringstream numbers(line);
      int id = 0;
      GivenCorners corners;
      numbers >> id;
      for (Vector2d& corner : corners) numbers >> corner.x() >> corner.y();
      if (!numbers) continue;
      ++given;
      const Vector2d middle = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
      for (const TagDetection& tag : tags) {
        const Vector2d own =
            (tag.corners_px[0] + tag.corners_px[1] + tag.corners_px[2] + tag.corners_px[3]) / 4;
        if ((own - middle).norm() > 4) continue;
        ++found;
        sum += (own - middle + Vector2d(0.5, 0.5)).squaredNorm() / 2;
        break;
      }
    }
    EXPECT_GE(found, given * 9 / 10) << name;
    EXPECT_LT(std::sqrt(sum / found), 0.2) << name;
  }
}

}  // namespace
}  // namespace slamscope::tracking
