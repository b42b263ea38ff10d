// SPDX-License-Identifier: MIT
#include "slam/formats/victoria_park.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "slam/csv_scans.hpp"
#include "slam/formats/zip_archive.hpp"

namespace slamscope::slam {
namespace {

constexpr std::size_t kReturns = 361;
constexpr double kNoReturn = 81.0;  // m; the device says 81.83 to 81.91
constexpr double kFastest = 8.0;    // m/s, between two fixes; the truck drives up to 5
constexpr std::chrono::seconds kLongestGap{2};

std::string contentOf(Bytes& bytes) {
  std::string content;
  std::size_t size = 0;
  do {
    const std::size_t before = content.size();
    content.resize(before + (std::size_t{1} << 20U));
    size = bytes.read({content.data() + before, content.size() - before});
    content.resize(before + size);
  } while (size != 0);
  return content;
}

std::string fileContent(const std::filesystem::path& base, const std::string& name) {
  if (std::filesystem::exists(base / name)) {
    FileBytes bytes(base / name);
    return contentOf(bytes);
  }
  const std::filesystem::path zip = base / "victoria_park_ascii.zip";
  if (!std::filesystem::exists(zip)) {
    throw std::runtime_error(base.string() + ": expected victoria_park_ascii.zip or " + name);
  }
  const ZipArchive archive(zip);
  if (!archive.members().contains(name)) {
    throw std::runtime_error(zip.string() + ": expected " + name + " in it, found none");
  }
  return contentOf(*archive.open(name));
}

/// Numbers between blanks and ends of lines, however they are broken into lines.
std::vector<double> numbersOf(const std::string& text, const std::string& name) {
  std::vector<double> numbers;
  numbers.reserve(text.size() / 6);
  constexpr std::string_view kBlank = " \t\r\n";
  for (std::size_t at = text.find_first_not_of(kBlank); at != text.npos;
       at = text.find_first_not_of(kBlank, at)) {
    const std::size_t stop = std::min(text.find_first_of(kBlank, at), text.size());
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + stop, value);
    if (error != std::errc() || end != text.data() + stop || !std::isfinite(value)) {
      throw std::runtime_error(name + ": number " + std::to_string(numbers.size() + 1) +
                               ": expected a number, found " + text.substr(at, stop - at));
    }
    numbers.push_back(value);
    at = stop;
  }
  return numbers;
}

std::chrono::nanoseconds timeAt(const std::vector<double>& numbers, std::size_t k, double before,
                                const std::string& name) {
  if (numbers[k] < before) {
    throw std::runtime_error(name + ": number " + std::to_string(k + 1) +
                             ": expected a time not before " + std::to_string(before) +
                             " s, found " + std::to_string(numbers[k]));
  }
  return std::chrono::nanoseconds(std::llround(numbers[k] * 1e9));
}

std::vector<double> tableOf(const std::filesystem::path& base, const std::string& name) {
  std::vector<double> numbers = numbersOf(fileContent(base, name), name);
  if (numbers.size() % 3 != 0) {
    throw std::runtime_error(name + ": expected three numbers a row, found " +
                             std::to_string(numbers.size()) + " numbers");
  }
  return numbers;
}

void readTruck(const std::filesystem::path& base, Recording& recording) {
  recording.odometry_kind = Recording::Odometry::ackermann;
  recording.vehicle = {.wheelbase = 2.83, .encoder_left = 0.76};
  recording.laser.pose_robot = {0.95 + 2.83, 0.5, 0.0};
  const std::vector<double> rows = tableOf(base, "DRS.txt");
  for (std::size_t k = 0; k < rows.size(); k += 3) {
    const auto time = timeAt(rows, k, k == 0 ? 0.0 : rows[k - 3], "DRS.txt");
    recording.odometry.push_back({time, {rows[k + 1], 0.0, rows[k + 2]}});
  }
}

void readScans(const std::filesystem::path& base, Recording& recording) {
  constexpr std::size_t kRow = kReturns + 1;
  const std::vector<double> numbers = numbersOf(fileContent(base, "LASER.txt"), "LASER.txt");
  for (std::size_t k = 0; k + kRow <= numbers.size(); k += kRow) {
    LaserScan scan;
    scan.time = timeAt(numbers, k, k == 0 ? 0.0 : numbers[k - kRow], "LASER.txt");
    if (!recording.scans.empty() && recording.scans.back().time == scan.time) continue;
    scan.angle_min = -std::numbers::pi / 2.0;
    scan.angle_step = std::numbers::pi / (kReturns - 1);
    for (std::size_t r = 0; r < kReturns; ++r) {
      const double range = numbers[k + 1 + r];
      scan.ranges.push_back(range < kNoReturn ? range : std::nan(""));
    }
    recording.scans.push_back(std::move(scan));
  }
  recording.ids_known = false;
  if (numbers.size() % kRow == 0) return;
  recording.warnings.push_back("LASER.txt: the last scan is cut off and left out, " +
                               std::to_string(numbers.size() % kRow) + " numbers of " +
                               std::to_string(kRow));
}

/// A fix counts where it is as far from the last one that counts as a truck can drive; after a gap
/// anything goes.
void readGps(const std::filesystem::path& base, Recording& recording) {
  const std::vector<double> rows = tableOf(base, "GPS.txt");
  std::size_t jumps = 0;
  for (std::size_t k = 0; k < rows.size(); k += 3) {
    TimedPose fix;
    fix.time = timeAt(rows, k, k == 0 ? 0.0 : rows[k - 3], "GPS.txt");
    fix.pose = {rows[k + 2], rows[k + 1], std::nan("")};  // east, north
    if (!recording.truth_path.empty()) {
      const TimedPose& last = recording.truth_path.back();
      const double distance = (fix.pose - last.pose).head<2>().norm();
      const double since = seconds(fix.time - last.time);
      if (distance > 1.0 + kFastest * since && fix.time - last.time < kLongestGap) {
        ++jumps;
        continue;
      }
    }
    recording.truth_path.push_back(fix);
  }
  recording.longest_truth_gap = kLongestGap;
  if (jumps == 0) return;
  recording.warnings.push_back("GPS.txt: " + std::to_string(jumps) +
                               " fixes jump away from the ones before and are left out");
}

}  // namespace

Recording readVictoriaPark(const std::string& directory) {
  if (!std::filesystem::is_directory(directory)) {
    throw std::runtime_error(directory + ": expected a directory with victoria_park_ascii.zip");
  }
  Recording recording;
  recording.name = "Victoria Park";
  recording.separation = 1.5;  // trees
  readTruck(directory, recording);
  readScans(directory, recording);
  readGps(directory, recording);
  requireInput(recording, directory);
  warnOfOddScans(recording);
  warnOfOddNumbers(recording);
  return recording;
}

}  // namespace slamscope::slam
