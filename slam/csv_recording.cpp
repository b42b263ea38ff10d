// SPDX-License-Identifier: MIT
#include "slam/csv_recording.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "slam/csv_scans.hpp"
#include "slam/csv_table.hpp"

namespace slamscope::slam {
namespace {

using Names = std::vector<std::string_view>;

/// Changes of single letters that turn one word into the other (Levenshtein).
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t k = 0; k <= b.size(); ++k) row[k] = k;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[k - 1] ? 0 : 1);
      diagonal = row[k];
      row[k] = std::min({replaced, row[k] + 1, row[k - 1] + 1});
    }
  }
  return row.back();
}

std::string join(const Names& names) {
  std::string text;
  for (const auto name : names) text.append(text.empty() ? "" : ",").append(name);
  return text;
}

/// A CSV file whose header has been read: cells by the name of their column.
class NamedTable {
 public:
  NamedTable(const std::string& path, const Names& known)
      : table_(path, TextTable::Separator::comma) {
    if (!table_.next()) table_.fail("header", join(known), "an empty file");
    for (std::size_t cell = 0; cell < table_.cells(); ++cell) {
      const std::string_view name = table_.text(cell);
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        const auto nearest = *std::min_element(known.begin(), known.end(), [&](auto a, auto b) {
          return distance(name, a) < distance(name, b);
        });
        table_.fail(name.empty() ? "header" : name, "a column of " + join(known),
                    "an unknown name (nearest: " + std::string(nearest) + ")");
      }
      if (std::find(columns_.begin(), columns_.end(), name) != columns_.end()) {
        table_.fail(name, "each column once", "two of them");
      }
      columns_.emplace_back(name);
    }
  }

  [[nodiscard]] bool has(std::string_view name) const {
    return std::find(columns_.begin(), columns_.end(), name) != columns_.end();
  }
  [[nodiscard]] bool hasAny(const Names& names) const {
    return std::any_of(names.begin(), names.end(), [&](auto name) { return has(name); });
  }
  void require(const Names& names) const {
    for (const auto name : names) {
      if (!has(name)) table_.fail(name, "a column of this name beside the others", "none");
    }
  }
  bool next() {
    if (!table_.next()) return false;
    table_.expectCells(columns_.size(), "row");
    return true;
  }
  [[nodiscard]] std::chrono::nanoseconds time() { return table_.time(cell("time_s"), "time_s"); }
  [[nodiscard]] double number(std::string_view name) const {
    return table_.number(cell(name), name);
  }
  [[nodiscard]] double positive(std::string_view name) const {
    const double value = number(name);
    if (!(value > 0.0)) table_.fail(name, "a number above 0", table_.text(cell(name)));
    return value;
  }
  [[nodiscard]] bool given(std::string_view name) const {
    return has(name) && !table_.text(cell(name)).empty();
  }
  [[nodiscard]] FeatureId id() const { return table_.id(cell("id"), "id"); }

 private:
  [[nodiscard]] std::size_t cell(std::string_view name) const {
    return static_cast<std::size_t>(std::find(columns_.begin(), columns_.end(), name) -
                                    columns_.begin());
  }

  TextTable table_;
  std::vector<std::string> columns_;
};

void readOdometry(const std::string& path, Recording& recording) {
  const Names velocity{"forward_mps", "turn_radps"};
  const Names car{"speed_mps", "steering_rad"};
  const Names increment{"dx_m", "dy_m", "dtheta_rad"};
  NamedTable table(path, {"time_s", "forward_mps", "turn_radps", "speed_mps", "steering_rad",
                          "dx_m", "dy_m", "dtheta_rad"});
  const bool moved = table.hasAny(increment) && !table.hasAny(velocity) && !table.hasAny(car);
  const bool steered = table.hasAny(car) && !table.hasAny(velocity);
  table.require({"time_s"});
  const Names& columns = moved ? increment : steered ? car : velocity;
  table.require(columns);
  recording.odometry_kind = moved     ? Recording::Odometry::increment
                            : steered ? Recording::Odometry::ackermann
                                      : Recording::Odometry::velocity;
  std::uint64_t equal = 0;
  while (table.next()) {
    OdometryEntry entry;
    entry.time = table.time();
    entry.motion = {table.number(columns.front()), moved ? table.number("dy_m") : 0.0,
                    table.number(columns.back())};
    if (!recording.odometry.empty() && recording.odometry.back().time == entry.time) ++equal;
    recording.odometry.push_back(entry);
  }
  if (equal == 0) return;
  recording.warnings.push_back(path + ": " + std::to_string(equal) +
                               " rows have the time of the row before");
}

void readSightings(const std::string& path, Recording& recording) {
  const Names sigmas{"sigma_range_m", "sigma_bearing_rad"};
  NamedTable table(
      path, {"time_s", "id", "range_m", "bearing_rad", "sigma_range_m", "sigma_bearing_rad"});
  table.require({"time_s", "range_m", "bearing_rad"});
  if (table.hasAny(sigmas)) table.require(sigmas);
  recording.ids_known = table.has("id");
  std::uint64_t twice = 0;
  while (table.next()) {
    Sighting seen{recording.ids_known ? table.id() : 0,
                  {table.positive("range_m"), table.number("bearing_rad")}};
    if (table.given(sigmas[0]) || table.given(sigmas[1])) {
      const Eigen::Vector2d sigma(table.positive(sigmas[0]), table.positive(sigmas[1]));
      seen.R = Eigen::Matrix2d(sigma.cwiseAbs2().asDiagonal());
    }
    const auto time = table.time();
    if (recording.ids_known && !recording.sightings.empty() &&
        recording.sightings.back().time == time) {
      const auto& group = recording.sightings.back().seen;
      twice += static_cast<std::uint64_t>(std::count_if(
          group.begin(), group.end(), [&](const Sighting& other) { return other.id == seen.id; }));
    }
    addSighting(recording, time, seen);
  }
  if (twice == 0) return;
  recording.warnings.push_back(path + ": " + std::to_string(twice) +
                               " sightings have time and id of another one");
}

void readTruePath(const std::string& path, Recording& recording) {
  if (!std::filesystem::exists(path)) return;
  const Names names{"time_s", "x_m", "y_m", "theta_rad"};
  NamedTable table(path, names);
  table.require(names);
  while (table.next()) {
    TimedPose sample;
    sample.time = table.time();
    sample.pose = {table.number("x_m"), table.number("y_m"), table.number("theta_rad")};
    recording.truth_path.push_back(sample);
  }
}

void readTrueFeatures(const std::string& path, Recording& recording) {
  if (!std::filesystem::exists(path)) return;
  const Names names{"id", "x_m", "y_m"};
  NamedTable table(path, names);
  table.require(names);
  while (table.next()) {
    recording.truth_features.emplace_back(
        table.id(), Eigen::Vector2d(table.number("x_m"), table.number("y_m")));
  }
}

}  // namespace

Recording readCsv(const std::string& directory) {
  const std::filesystem::path base(directory);
  if (!std::filesystem::is_directory(base)) {
    throw std::runtime_error(directory +
                             ": expected a directory with odometry.csv and range_bearing.csv");
  }
  Recording recording;
  recording.name = std::filesystem::absolute(base).lexically_normal().filename().string();
  if (recording.name.empty()) recording.name = directory;
  readOdometry(base / "odometry.csv", recording);
  const bool scanned = std::filesystem::exists(base / "scans.csv");
  if (scanned && std::filesystem::exists(base / "range_bearing.csv")) {
    throw std::runtime_error(directory + ": scans.csv and range_bearing.csv: expected one of them");
  }
  if (scanned) {
    readCsvScans(base / "scans.csv", base / "intensities.csv", recording);
  } else {
    readSightings(base / "range_bearing.csv", recording);
  }
  readTruePath(base / "truth_path.csv", recording);
  readTrueFeatures(base / "truth_features.csv", recording);
  requireInput(recording, directory);
  moveTruthIntoMap(recording);
  warnOfOddNumbers(recording);
  return recording;
}

}  // namespace slamscope::slam
