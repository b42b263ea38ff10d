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
#include <optional>
#include <sstream>

#include "tests/tracking/recorded.hpp"
#include "tracking/registration.hpp"
#include "tracking/tag_detector.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Vector2d;
using testing::GivenCorners, testing::detect, testing::recorded, testing::Sequence;

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
