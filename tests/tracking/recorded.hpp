// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/read_picture.hpp"
#include "tracking/tag_detector.hpp"
#include "tracking/tag_layout.hpp"

// Recorded pictures, where they are at hand: see the data's own README for sources.
namespace slamscope::tracking::testing {

using GivenCorners = std::array<Eigen::Vector2d, 4>;
namespace fs = std::filesystem;

inline std::optional<fs::path> recorded(const std::string& folder) {
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

inline std::vector<TagDetection> detect(TagDetector& detector, const fs::path& file) {
  const cv::Mat picture = test::readPicture(file);
  return detector.detect({picture.data, picture.cols, picture.rows, 3});
}

inline Eigen::Isometry3d poseOf(const nlohmann::json& rows) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c)
      T.matrix()(r, c) = rows[std::size_t(r)][std::size_t(c)].get<double>();
  }
  return T;
}

/// What ViSP found in the sequence, and the board by it: mean pose of each tag over all frames.
struct Sequence {
  std::vector<std::map<int, GivenCorners>> corners;
  std::vector<Eigen::Isometry3d> T_camera_board;
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
              Eigen::Vector2d(row_column[1].get<double>(), row_column[0].get<double>());
        }
        const Eigen::Isometry3d T_board_tag = T_camera_board.back().inverse() * poseOf(tag["cMo"]);
        Eigen::Vector4d q = Eigen::Quaterniond(T_board_tag.linear()).coeffs();
        auto& [place, turn] =
            sums.try_emplace(id, Eigen::Vector3d::Zero(), Eigen::Vector4d::Zero()).first->second;
        place += T_board_tag.translation();
        turn += q.dot(turn) < 0 ? Eigen::Vector4d(-q) : q;
        ++counts[id];
      }
    }
    for (const auto& [id, sum] : sums) {
      MappedTag tag{id, json["tag_size"], Eigen::Isometry3d::Identity()};
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

}  // namespace slamscope::tracking::testing
