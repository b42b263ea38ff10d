// SPDX-License-Identifier: MIT
#include "slam/mrclam.hpp"

#include <filesystem>
#include <map>
#include <stdexcept>

#include "slam/csv_table.hpp"

namespace slamscope::slam {
namespace {

using Separator = TextTable::Separator;

constexpr FeatureId kFirstLandmark = 6;  // subjects 1–5 are the robots
constexpr FeatureId kLastLandmark = 20;

void readOdometry(const std::string& path, Recording& recording) {
  TextTable table(path, Separator::blank);
  while (table.next()) {
    table.expectCells(3, "time, forward velocity, angular velocity");
    OdometryEntry entry;
    entry.time = table.time(0, "time");
    entry.motion = {table.number(1, "forward velocity"), 0.0, table.number(2, "angular velocity")};
    recording.odometry.push_back(entry);
  }
}

std::map<FeatureId, FeatureId> readBarcodes(const std::string& path) {
  std::map<FeatureId, FeatureId> subjects;
  TextTable table(path, Separator::blank);
  while (table.next()) {
    table.expectCells(2, "subject, barcode");
    subjects.emplace(table.id(1, "barcode"), table.id(0, "subject"));
  }
  return subjects;
}

/// The column "Subject #" of this file holds barcodes.
void readSightings(const std::string& path, const std::map<FeatureId, FeatureId>& subjects,
                   Recording& recording) {
  TextTable table(path, Separator::blank);
  while (table.next()) {
    table.expectCells(4, "time, barcode, range, bearing");
    const auto time = table.time(0, "time");
    const auto subject = subjects.find(table.id(1, "barcode"));
    const Sighting seen{subject == subjects.end() ? 0 : subject->second,
                        {table.number(2, "range"), table.number(3, "bearing")}};
    if (seen.id < kFirstLandmark || seen.id > kLastLandmark) {
      ++(subject == subjects.end() ? recording.unknown_ids : recording.ignored_sightings);
      continue;
    }
    addSighting(recording, time, seen);
  }
}

void readTruePath(const std::string& path, Recording& recording) {
  if (!std::filesystem::exists(path)) return;
  TextTable table(path, Separator::blank);
  while (table.next()) {
    table.expectCells(4, "time, x, y, orientation");
    TimedPose sample;
    sample.time = table.time(0, "time");
    sample.pose = {table.number(1, "x"), table.number(2, "y"), table.number(3, "orientation")};
    recording.truth_path.push_back(sample);
  }
}

void readTrueFeatures(const std::string& path, Recording& recording) {
  if (!std::filesystem::exists(path)) return;
  TextTable table(path, Separator::blank);
  while (table.next()) {
    table.expectCells(5, "subject, x, y, x std-dev, y std-dev");
    recording.truth_features.emplace_back(
        table.id(0, "subject"), Eigen::Vector2d(table.number(1, "x"), table.number(2, "y")));
  }
}

void addWarnings(Recording& recording) {
  const auto warn = [&](std::uint64_t count, const std::string& what) {
    if (count == 0) return;
    recording.warnings.push_back(recording.name + ": " + std::to_string(count) + what);
  };
  warn(recording.unknown_ids, " sightings of barcodes that Barcodes.dat does not list, left out");
  warn(recording.equal_stamps,
       " sightings with the time stamp of the one before, used together with it");
}

}  // namespace

Recording readMrclam(const std::string& directory, int robot) {
  if (!std::filesystem::is_directory(directory)) {
    throw std::runtime_error(directory + ": expected a directory of MR.CLAM files");
  }
  const std::string base = directory + "/";
  const std::string of_robot = base + "Robot" + std::to_string(robot) + "_";
  Recording recording;
  recording.name = "MR.CLAM robot " + std::to_string(robot);
  readOdometry(of_robot + "Odometry.dat", recording);
  readSightings(of_robot + "Measurement.dat", readBarcodes(base + "Barcodes.dat"), recording);
  readTruePath(of_robot + "Groundtruth.dat", recording);
  readTrueFeatures(base + "Landmark_Groundtruth.dat", recording);
  requireInput(recording, directory);
  moveTruthIntoMap(recording);
  addWarnings(recording);
  return recording;
}

}  // namespace slamscope::slam
