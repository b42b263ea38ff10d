// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/lib/view/monitor.hpp"
#include "tests/read_picture.hpp"

// The paper's experiment as mode alarms shows it: report and pixels.
namespace slamscope::apps {
namespace {

namespace fs = std::filesystem;

struct Film {
  nlohmann::json frames;
  cv::Mat last;
};

Film alarmFilm(const std::string& fault) {
  const fs::path folder =
      fs::temp_directory_path() / ("slamscope-alarms-" + std::to_string(getpid()));
  fs::create_directories(folder);
  MonitorOptions options;
  options.simulation.loops = 1;
  options.simulation.fault = fault;
  options.simulation.fault_features = {8};
  options.slam_rate = 6.0;
  options.mode = slam::PairMode::alarms;
  options.legend = false;
  options.labels = false;
  options.picture = folder / "last.png";
  options.report = folder / "report.json";
  Monitor monitor(options);
  while (monitor.next()) monitor.draw();
  monitor.finish(Viewer::Ending::input_ended);
  Film result{.frames = nlohmann::json::parse(std::ifstream(options.report))["frames"],
              .last = test::readPicture(options.picture)};
  fs::remove_all(folder);
  return result;
}

const Film& faulty() {
  static const Film one = alarmFilm("paper");
  return one;
}
const Film& healthy() {
  static const Film one = alarmFilm("none");
  return one;
}

bool magenta(const cv::Vec3b& bgr) {
  return bgr[0] > bgr[1] + 60 && bgr[2] > bgr[1] + 60;
}

/// Share of magenta among the pixels that are `radius` or nearer to the tip.
double magentaAround(const Film& shown, std::uint64_t feature, int radius) {
  for (const auto& tip : shown.frames.back()["tips_px"]) {
    if (tip[0] != feature) continue;
    const int x = static_cast<int>(tip[1].get<double>());
    const int y = static_cast<int>(tip[2].get<double>());
    const cv::Rect picture(0, 0, shown.last.cols, shown.last.rows);
    const cv::Mat part =
        shown.last(cv::Rect(x - radius, y - radius, 2 * radius + 1, 2 * radius + 1) & picture);
    int found = 0;
    for (int row = 0; row < part.rows; ++row) {
      for (int col = 0; col < part.cols; ++col) found += magenta(part.at<cv::Vec3b>(row, col));
    }
    return static_cast<double>(found) / static_cast<double>(part.total());
  }
  ADD_FAILURE() << "feature " << feature << " is not in the picture";
  return 0.0;
}

TEST(AlarmsEndToEnd, FaultyFeatureIsFlaggedFromTheRecordWhereTheFaultBegins) {
  std::optional<std::uint64_t> first;
  for (const auto& frame : faulty().frames) {
    const auto& alarms = frame["alarms"];
    if (alarms["blamed"].empty()) {
      EXPECT_TRUE(alarms["broken"].empty());
      EXPECT_FALSE(first) << "an alarm went away";
      continue;
    }
    EXPECT_EQ(alarms["flagged"], nlohmann::json::array({8}));
    if (!first) first = alarms["blamed"][0]["record"];
    EXPECT_EQ(alarms["broken"][0]["first_record"], *first);
    EXPECT_LE(*first, alarms["record"].get<std::uint64_t>());
  }
  ASSERT_TRUE(first);
  EXPECT_GT(*first, 50U);  // feature 8 is born when the robot turns to it
  const auto& last = faulty().frames.back();
  EXPECT_EQ(last["drawn"]["features"], 1);
  EXPECT_EQ(last["drawn"]["ellipsoids"], 14);
  EXPECT_EQ(last["alarms"]["flagged_pairs"], 14);
}

TEST(AlarmsEndToEnd, MagentaStandsAroundTheFaultyFeatureOnly) {
  EXPECT_GT(magentaAround(faulty(), 8, 40), 0.5);
  // Where pairs with feature 8 end a thin line arrives.
  for (const std::uint64_t other : {1, 3, 12, 14}) {
    EXPECT_LT(magentaAround(faulty(), other, 20), 0.1) << "feature " << other;
  }
}

TEST(AlarmsEndToEnd, HealthyTwinIsNeverFlaggedAndHasNothingMagenta) {
  for (const auto& frame : healthy().frames) {
    EXPECT_TRUE(frame["alarms"]["flagged"].empty());
    EXPECT_TRUE(frame["alarms"]["broken"].empty());
    EXPECT_EQ(frame["drawn"]["ellipsoids"], 0);
  }
  EXPECT_GT(healthy().frames.back()["alarms"]["records"], 400);
  for (std::uint64_t feature = 1; feature <= 15; ++feature) {
    EXPECT_EQ(magentaAround(healthy(), feature, 40), 0.0) << "feature " << feature;
  }
}

}  // namespace
}  // namespace slamscope::apps
