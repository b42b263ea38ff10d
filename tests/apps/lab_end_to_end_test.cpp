// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/lib/view/monitor.hpp"
#include "tests/apps/cone_tip.hpp"
#include "tests/read_picture.hpp"

// From the lab's camera to the pixels of the written pictures.
namespace slamscope::apps {
namespace {

namespace fs = std::filesystem;

struct Run {
  nlohmann::json report, truth;
  cv::Mat last_picture;
};

/// A short film of the paper's map to the end of a run, so that all features are known.
Run film(double opacity) {
  const fs::path folder = fs::temp_directory_path() / ("slamscope-lab-" + std::to_string(getpid()));
  fs::create_directories(folder);
  MonitorOptions options;
  options.simulation.loops = 1;
  options.slam_rate = 12.0;
  options.mode = slam::PairMode::min_mean_max;
  options.labels = false;
  options.legend = false;
  options.opacity = opacity;
  options.validation = true;
  options.picture = folder / "last.png";
  options.report = folder / "report.json";
  options.lab_truth = folder / "truth.json";
  Monitor monitor(options);
  while (monitor.next()) monitor.draw();
  monitor.finish(Viewer::Ending::input_ended);
  EXPECT_TRUE(monitor.gpu()->validationMessages().empty());
  Run run{.report = nlohmann::json::parse(std::ifstream(options.report)),
          .truth = nlohmann::json::parse(std::ifstream(options.lab_truth)),
          .last_picture = test::readPicture(options.picture)};
  fs::remove_all(folder);
  return run;
}

const Run& drawn() {
  static const Run run = film(1.0);
  return run;
}

TEST(LabEndToEnd, OverlayErrorIsUnderHalfAPixel) {
  const auto& errors = drawn().report["summary"]["overlay_error_px"];
  EXPECT_LE(errors["p95"].get<double>(), 0.5);
  RecordProperty("overlay_p95_px", std::to_string(errors["p95"].get<double>()));
}

TEST(LabEndToEnd, EveryFeatureIsDrawnAtTheEnd) {
  const auto& last = drawn().report["frames"].back();
  EXPECT_EQ(last["drawn"]["features"], 15);
  EXPECT_EQ(last["drawn"]["ellipsoids"], 9);
  EXPECT_EQ(last["registration"]["state"], "registered");
}

TEST(LabEndToEnd, ConeTipsMeasuredInThePictureAgreeWithTheReport) {
  const auto& last = drawn().report["frames"].back();
  const test::PicturePair pictures{.drawn = drawn().last_picture, .bare = film(0.0).last_picture};
  ASSERT_FALSE(pictures.drawn.empty());
  ASSERT_EQ(pictures.drawn.size(), pictures.bare.size());
  Eigen::Matrix4d T_camera_map;
  for (int row = 0; row < 4; ++row) {
    for (int col = 0; col < 4; ++col) {
      T_camera_map(row, col) = last["registration"]["T_camera_map"][row][col];
    }
  }
  // Upwards in the picture: the vanishing point of the vertical gives each cone's axis.
  const auto& K = drawn().truth["camera_matrix"];
  const Eigen::Vector3d up = T_camera_map.block<3, 1>(0, 2);
  const auto number = [&K](int row, int col) { return K[row][col].get<double>(); };
  const Eigen::Vector2d vanishing(number(0, 0) * up.x() / up.z() + number(0, 2),
                                  number(1, 1) * up.y() / up.z() + number(1, 2));
  int measured = 0;
  for (const auto& tip : last["tips_px"]) {
    const Eigen::Vector2d reported(tip[1], tip[2]);
    const Eigen::Vector2d away = (reported - vanishing).normalized();
    const auto found = test::measuredTip(pictures, reported, reported + 24.0 * away);
    if (!found) continue;  // covered by a glyph, or seen from straight above
    ++measured;
    EXPECT_LT((*found - reported).norm(), 0.2)
        << "feature " << tip[0] << ", along and across the axis " << (*found - reported).dot(away)
        << " " << (*found - reported).dot(Eigen::Vector2d(-away.y(), away.x()));
    // Twin: half a pixel off would be seen.
    EXPECT_GT((*found - reported - Eigen::Vector2d(0.5, 0.5)).norm(), 0.2);
  }
  EXPECT_GE(measured, 8);
}

}  // namespace
}  // namespace slamscope::apps
