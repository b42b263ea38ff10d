// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "slam/laser_scan.hpp"
#include "slam/models.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// One line of odometry, in the frame of the robot (x forward, y left).
struct OdometryEntry {
  std::chrono::nanoseconds time{};
  /// Recording::Odometry::velocity: forward (m/s), 0, turn (rad/s), held until the next entry.
  /// Recording::Odometry::ackermann: speed (m/s), 0, steering (rad), held until the next entry.
  /// Recording::Odometry::increment: dx, dy (m), dθ (rad) moved since the entry before.
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  std::optional<Eigen::Matrix3d> M{};  ///< covariance of an increment, where recorded
};

/// One sighting of a feature.
struct Sighting {
  FeatureId id = 0;  ///< 0 where not known
  /// As the recording's sensor reads it: range (m) and bearing (rad, left positive, 0 ahead), or x
  /// and y (m) in the robot's frame.
  Eigen::Vector2d z = Eigen::Vector2d::Zero();
  std::optional<Eigen::Matrix2d> R{};  ///< covariance of z, where recorded
};

/// What was seen at one time.
struct Sightings {
  std::chrono::nanoseconds time{};
  std::vector<Sighting> seen;
};

struct TimedPose {
  std::chrono::nanoseconds time{};
  Eigen::Vector3d pose = Eigen::Vector3d::Zero();  ///< x, y (m), θ (rad)
};

/// Recorded input of a SLAM filter, whoever recorded it: see mrclam.hpp, csv_recording.hpp.
struct Recording {
  enum class Odometry { velocity, increment, ackermann };

  std::string name;  ///< for titles: "mrclam robot 3"
  Odometry odometry_kind = Odometry::velocity;
  std::vector<OdometryEntry> odometry;  ///< time never goes back
  AckermannGeometry vehicle;            ///< of Odometry::ackermann

  Sensor sensor = Sensor::range_bearing;
  std::vector<Sightings> sightings;  ///< time increases strictly
  bool ids_known = true;             ///< of `sightings`; never of `scans`
  /// Instead of sightings: what a laser measured. Time increases strictly.
  std::vector<LaserScan> scans;
  LaserMount laser;
  double separation = 0.0;  ///< m; no two features are nearer to each other, where that is known

  /// Empty where not recorded; time never goes back. The heading is NaN where it was not measured.
  std::vector<TimedPose> truth_path;
  /// Where samples of the path are further apart the truth is not known between them.
  std::chrono::nanoseconds longest_truth_gap = std::chrono::nanoseconds::max();
  std::vector<std::pair<FeatureId, Eigen::Vector2d>> truth_features;  ///< m, by id
  /// The truth is given in the frame of the map (origin: the true pose at `start`). False where no
  /// true path is known: the features are then in a frame of their own.
  bool truth_in_map = false;

  std::uint64_t unknown_ids = 0;        ///< sightings of barcodes that map to nothing
  std::uint64_t ignored_sightings = 0;  ///< sightings of other robots
  std::uint64_t equal_stamps = 0;       ///< sightings beyond the first at one time
  std::vector<std::string> warnings;    ///< one line each, for people

  /// Times at which something was sensed, sightings or scans, in order.
  [[nodiscard]] std::size_t sensedCount() const;
  [[nodiscard]] std::chrono::nanoseconds sensedAt(std::size_t index) const;
  /// Time of the first odometry entry or sighting: when the map's origin is set.
  [[nodiscard]] std::chrono::nanoseconds start() const;
  [[nodiscard]] std::chrono::nanoseconds end() const;
  /// True pose at `time`, interpolated; nothing outside of the recorded path.
  [[nodiscard]] std::optional<Eigen::Vector3d> truthAt(std::chrono::nanoseconds time) const;
};

/// Moves path and features into the frame of the map. For readers; does nothing without a path, nor
/// where its headings are not known.
void moveTruthIntoMap(Recording& recording);

/// Throws std::runtime_error where there is no odometry or nothing was sensed. For readers.
void requireInput(const Recording& recording, const std::string& path);

/// Adds a line to `warnings` where there is anything to say: odometry and readings with gaps of
/// minutes, angles that look like degrees. For readers.
void warnOfOddNumbers(Recording& recording);

/// Puts sightings of equal time into one group; counts equal stamps. For readers: `seen` by time.
void addSighting(Recording& recording, std::chrono::nanoseconds time, const Sighting& seen);

}  // namespace slamscope::slam
