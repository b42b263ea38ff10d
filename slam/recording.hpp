// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// One line of odometry, in the frame of the robot (x forward, y left).
struct OdometryEntry {
  std::chrono::nanoseconds time{};
  /// Recording::Odometry::velocity: forward (m/s), 0, turn (rad/s), held until the next entry.
  /// Recording::Odometry::increment: dx, dy (m), dθ (rad) moved since the entry before.
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
};

/// One sighting of a known feature.
struct RangeBearing {
  FeatureId id = 0;
  double range = 0.0;                    ///< m
  double bearing = 0.0;                  ///< rad, left positive, 0 ahead
  std::optional<Eigen::Vector2d> sigma;  ///< σ of range (m) and bearing (rad), where recorded
};

/// What was seen at one time.
struct Sightings {
  std::chrono::nanoseconds time{};
  std::vector<RangeBearing> seen;
};

struct TimedPose {
  std::chrono::nanoseconds time{};
  Eigen::Vector3d pose = Eigen::Vector3d::Zero();  ///< x, y (m), θ (rad)
};

/// Recorded input of a SLAM filter, whoever recorded it: see mrclam.hpp, csv_recording.hpp.
struct Recording {
  enum class Odometry { velocity, increment };

  std::string name;  ///< for titles: "mrclam robot 3"
  Odometry odometry_kind = Odometry::velocity;
  std::vector<OdometryEntry> odometry;  ///< time never goes back
  std::vector<Sightings> sightings;     ///< time increases strictly

  std::vector<TimedPose> truth_path;  ///< empty where not recorded; time never goes back
  std::vector<std::pair<FeatureId, Eigen::Vector2d>> truth_features;  ///< m, by id
  /// The truth is given in the frame of the map (origin: the true pose at `start`). False where no
  /// true path is known: the features are then in a frame of their own.
  bool truth_in_map = false;

  std::uint64_t unknown_ids = 0;        ///< sightings of barcodes that map to nothing
  std::uint64_t ignored_sightings = 0;  ///< sightings of other robots
  std::uint64_t equal_stamps = 0;       ///< sightings beyond the first at one time
  std::vector<std::string> warnings;    ///< one line each, for people

  /// Time of the first odometry entry or sighting: when the map's origin is set.
  [[nodiscard]] std::chrono::nanoseconds start() const;
  [[nodiscard]] std::chrono::nanoseconds end() const;
  /// True pose at `time`, interpolated; nothing outside of the recorded path.
  [[nodiscard]] std::optional<Eigen::Vector3d> truthAt(std::chrono::nanoseconds time) const;
};

/// Moves path and features into the frame of the map. For readers; does nothing without a path.
void moveTruthIntoMap(Recording& recording);

/// Throws std::runtime_error where there is no odometry or nothing was seen. For readers.
void requireInput(const Recording& recording, const std::string& path);

/// Puts sightings of equal time into one group; counts equal stamps. For readers: `seen` by time.
void addSighting(Recording& recording, std::chrono::nanoseconds time, const RangeBearing& seen);

}  // namespace slamscope::slam
