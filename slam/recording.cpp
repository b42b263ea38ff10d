// SPDX-License-Identifier: MIT
#include "slam/recording.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "slam/angle.hpp"
#include "slam/models.hpp"

namespace slamscope::slam {

std::size_t Recording::sensedCount() const {
  return scans.empty() ? sightings.size() : scans.size();
}

std::chrono::nanoseconds Recording::sensedAt(std::size_t index) const {
  return scans.empty() ? sightings.at(index).time : scans.at(index).time;
}

std::chrono::nanoseconds Recording::start() const {
  const std::size_t count = sensedCount();
  if (odometry.empty()) return count == 0 ? std::chrono::nanoseconds{} : sensedAt(0);
  if (count == 0) return odometry.front().time;
  return std::min(odometry.front().time, sensedAt(0));
}

std::chrono::nanoseconds Recording::end() const {
  const std::size_t count = sensedCount();
  if (odometry.empty()) return count == 0 ? std::chrono::nanoseconds{} : sensedAt(count - 1);
  if (count == 0) return odometry.back().time;
  return std::max(odometry.back().time, sensedAt(count - 1));
}

std::optional<Eigen::Vector3d> Recording::truthAt(std::chrono::nanoseconds time) const {
  const auto after = std::lower_bound(
      truth_path.begin(), truth_path.end(), time,
      [](const TimedPose& pose, std::chrono::nanoseconds wanted) { return pose.time < wanted; });
  if (after == truth_path.end()) return std::nullopt;
  if (after->time == time) return after->pose;
  if (after == truth_path.begin()) return std::nullopt;
  const TimedPose& from = *std::prev(after);
  if (after->time - from.time > longest_truth_gap) return std::nullopt;
  const double share = std::chrono::duration<double>(time - from.time) /
                       std::chrono::duration<double>(after->time - from.time);
  Eigen::Vector3d moved = after->pose - from.pose;
  moved[2] = wrapAngle(moved[2]);
  Eigen::Vector3d pose = from.pose + share * moved;
  pose[2] = wrapAngle(pose[2]);
  return pose;
}

void moveTruthIntoMap(Recording& recording) {
  if (recording.truth_path.empty() || !recording.truth_path.front().pose.allFinite()) return;
  const auto at_start = recording.truthAt(recording.start());
  const Eigen::Vector3d origin = at_start.value_or(recording.truth_path.front().pose);
  if (!at_start) {
    recording.warnings.push_back(
        recording.name +
        ": the true path does not reach back to the start; its first pose is taken "
        "for the origin of the map");
  }
  for (TimedPose& sample : recording.truth_path) {
    sample.pose = incrementBetween(origin, sample.pose);
  }
  for (auto& [id, feature] : recording.truth_features) {
    const Eigen::Vector3d standing(feature.x(), feature.y(), 0.0);
    feature = incrementBetween(origin, standing).head<2>();
  }
  recording.truth_in_map = true;
}

void requireInput(const Recording& recording, const std::string& path) {
  if (recording.odometry.empty()) {
    throw std::runtime_error(path + ": expected odometry, found no entry");
  }
  if (recording.sensedCount() == 0) {
    throw std::runtime_error(path + ": expected sightings of features, found none");
  }
}

void addSighting(Recording& recording, std::chrono::nanoseconds time, const Sighting& seen) {
  auto& groups = recording.sightings;
  if (groups.empty() || groups.back().time != time) {
    groups.push_back({time, {}});
  } else {
    ++recording.equal_stamps;
  }
  groups.back().seen.push_back(seen);
}

namespace {

constexpr double kLongPause = 10.0;  // s, of odometry that comes many times a second

void warnAbove(Recording& recording, double limit, double worst, const char* what) {
  if (!(worst > limit)) return;
  std::ostringstream line;
  line << recording.name << ": " << what << " up to " << worst << " rad; are these degrees?";
  recording.warnings.push_back(line.str());
}

void warnOfAngles(Recording& recording) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  double steering = 0.0;
  double turn = 0.0;
  double bearing = 0.0;
  double scanned = 0.0;
  for (const OdometryEntry& entry : recording.odometry) {
    const bool car = recording.odometry_kind == Recording::Odometry::ackermann;
    double& worst = car ? steering : turn;
    worst = std::max(worst, std::abs(entry.motion[2]));
  }
  for (const Sightings& group : recording.sightings) {
    if (recording.sensor != Sensor::range_bearing) break;
    for (const Sighting& seen : group.seen) bearing = std::max(bearing, std::abs(seen.z[1]));
  }
  for (const LaserScan& scan : recording.scans) {
    scanned = std::max({scanned, std::abs(scan.angle_min),
                        std::abs(scan.angle_step) * static_cast<double>(scan.ranges.size())});
  }
  warnAbove(recording, kTurn / 4.0, steering, "steering of");
  warnAbove(recording, 2.0 * kTurn, turn, "turns of");  // 2 turns a second, or at one time
  warnAbove(recording, kTurn + 1e-6, bearing, "bearings of");
  warnAbove(recording, 1.1 * kTurn, scanned, "angles of scans of");
}

}  // namespace

void warnOfOddNumbers(Recording& recording) {
  warnOfAngles(recording);
  int pauses = 0;
  double longest = 0.0;
  for (std::size_t k = 1; k < recording.odometry.size(); ++k) {
    const double pause = seconds(recording.odometry[k].time - recording.odometry[k - 1].time);
    longest = std::max(longest, pause);
    pauses += pause > kLongPause ? 1 : 0;
  }
  if (pauses == 0) return;
  std::ostringstream line;
  line << recording.name << ": time jumps in the odometry, " << pauses << " times by more than "
       << kLongPause << " s, by " << longest
       << " s at the most; what was driven there is not known";
  recording.warnings.push_back(line.str());
}

}  // namespace slamscope::slam
