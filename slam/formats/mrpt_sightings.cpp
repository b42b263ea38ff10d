// SPDX-License-Identifier: MIT
#include "slam/formats/mrpt_sightings.hpp"

#include <filesystem>

#include "slam/csv_table.hpp"

namespace slamscope::slam {
namespace {

constexpr std::string_view kMrptSightings = "_range_bearing.txt";

void readMrptLandmarks(const std::string& path, Recording& recording) {
  if (!std::filesystem::exists(path)) return;
  TextTable table(path, TextTable::Separator::blank);
  while (table.next()) {
    if (table.cells() < 4) table.fail("row", "x, y, z … id", std::to_string(table.cells()));
    recording.truth_features.emplace_back(
        table.id(table.cells() - 1, "id"),
        Eigen::Vector2d(table.number(0, "x"), table.number(1, "y")));
  }
}

/// The pose at the start, then one for each time of sightings, in order; they carry no times.
void readMrptPath(const std::string& path, Recording& recording) {
  if (!std::filesystem::exists(path)) return;
  TextTable table(path, TextTable::Separator::blank);
  if (!table.next()) return;
  for (const Sightings& group : recording.sightings) {
    if (!table.next()) break;
    table.expectCells(6, "x, y, z, yaw, pitch, roll");
    recording.truth_path.push_back(
        {group.time, {table.number(0, "x"), table.number(1, "y"), table.number(3, "yaw")}});
  }
}

}  // namespace

Recording readMrptSightings(const std::string& path) {
  TextTable table(path, TextTable::Separator::blank);
  Recording recording;
  recording.name = std::filesystem::path(path).stem().string();
  while (table.next()) {
    table.expectCells(6, "time stamp, index, id, range, yaw, pitch");
    const auto time = table.time(0, "time stamp");
    Sighting seen{0, {table.number(3, "range"), table.number(4, "yaw")}};
    if (!(seen.z[0] > 0.0)) table.fail("range", "a number above 0", table.text(3));
    if (table.text(2) == "-1") {
      recording.ids_known = false;
    } else {
      seen.id = table.id(2, "id");
    }
    addSighting(recording, time, seen);
  }
  recording.equal_stamps = 0;  // all that was seen at one time has one stamp
  if (recording.sightings.empty()) table.fail("row", "sightings of features", "none");
  if (path.ends_with(kMrptSightings)) {
    const std::string base = path.substr(0, path.size() - kMrptSightings.size());
    readMrptLandmarks(base + "_ground_truth.txt", recording);
    readMrptPath(base + "_ground_truth_robot_path.txt", recording);
  }
  moveTruthIntoMap(recording);
  warnOfOddNumbers(recording);
  return recording;
}

}  // namespace slamscope::slam
