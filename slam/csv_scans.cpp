// SPDX-License-Identifier: MIT
#include "slam/csv_scans.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "slam/csv_table.hpp"

namespace slamscope::slam {
namespace {

constexpr std::array<std::string_view, 3> kScanColumns{"time_s", "angle_min_rad", "angle_step_rad"};

void readScanHeader(TextTable& table) {
  if (!table.next()) table.fail("header", "time_s,angle_min_rad,angle_step_rad,r0,…", "nothing");
  for (std::size_t k = 0; k < kScanColumns.size(); ++k) {
    const std::string_view found = k < table.cells() ? table.text(k) : "";
    if (found != kScanColumns[k]) table.fail("header", kScanColumns[k], found);
  }
}

std::vector<double> readReturns(const TextTable& table) {
  std::vector<double> values;
  values.reserve(table.cells());
  std::string column(1, 'r');
  for (std::size_t k = kScanColumns.size(); k < table.cells(); ++k) {
    column.resize(1);
    column += std::to_string(k - kScanColumns.size());
    values.push_back(table.numberIfAny(k, column));
  }
  return values;
}

bool nextScan(TextTable& table) {
  if (!table.next()) return false;
  if (table.cells() >= kScanColumns.size()) return true;
  table.fail("row", "time, first angle, step and returns",
             std::to_string(table.cells()) + " values");
}

void readIntensities(const std::string& path, std::vector<LaserScan>& scans) {
  TextTable table(path, TextTable::Separator::comma);
  readScanHeader(table);
  std::size_t k = 0;
  for (; nextScan(table); ++k) {
    if (k == scans.size()) table.fail("row", "as many rows as scans", "more");
    scans[k].intensities = readReturns(table);
    const std::size_t expected = scans[k].ranges.size();
    if (scans[k].intensities.size() != expected) {
      table.fail("row", std::to_string(expected) + " intensities, as the scan has ranges",
                 std::to_string(scans[k].intensities.size()));
    }
  }
  if (k != scans.size()) table.fail("row", "as many rows as scans", "the end");
}

void warnOfScans(Recording& recording, std::uint64_t count, const std::string& what) {
  if (count == 0) return;
  recording.warnings.push_back(recording.name + ": " + std::to_string(count) + what);
}

/// Scans of the time of the one before can't be told from its repetition.
void dropEqualTimes(std::vector<LaserScan>& scans, Recording& recording) {
  const auto end =
      std::unique(scans.begin(), scans.end(),
                  [](const LaserScan& a, const LaserScan& b) { return a.time == b.time; });
  warnOfScans(recording, static_cast<std::uint64_t>(scans.end() - end),
              " scans have the time of the one before and are left out");
  scans.erase(end, scans.end());
}

}  // namespace

void readCsvScans(const std::string& scans, const std::string& intensities, Recording& recording) {
  TextTable table(scans, TextTable::Separator::comma);
  readScanHeader(table);
  std::vector<LaserScan> read;
  while (nextScan(table)) {
    LaserScan& scan = read.emplace_back();
    scan.time = table.time(0, kScanColumns[0]);
    scan.angle_min = table.number(1, kScanColumns[1]);
    scan.angle_step = table.number(2, kScanColumns[2]);
    if (scan.angle_step == 0.0) table.fail(kScanColumns[2], "an angle that is not 0", "0");
    scan.ranges = readReturns(table);
  }
  if (std::filesystem::exists(intensities)) readIntensities(intensities, read);
  dropEqualTimes(read, recording);
  recording.scans = std::move(read);
  recording.ids_known = false;
  warnOfOddScans(recording);
}

void warnOfOddScans(Recording& recording) {
  std::uint64_t other_length = 0;
  std::uint64_t empty = 0;
  for (const LaserScan& scan : recording.scans) {
    if (scan.ranges.size() != recording.scans.front().ranges.size()) ++other_length;
    if (std::all_of(scan.ranges.begin(), scan.ranges.end(),
                    [](double range) { return std::isnan(range); })) {
      ++empty;
    }
  }
  warnOfScans(recording, other_length, " scans have another number of returns than the first");
  warnOfScans(recording, empty, " scans have no return at all");
}

}  // namespace slamscope::slam
