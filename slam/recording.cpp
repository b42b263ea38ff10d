// SPDX-License-Identifier: MIT
#include "slam/recording.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "slam/angle.hpp"
#include "slam/models.hpp"

namespace slamscope::slam {

std::chrono::nanoseconds Recording::start() const {
  if (odometry.empty() && sightings.empty()) return {};
  if (odometry.empty()) return sightings.front().time;
  if (sightings.empty()) return odometry.front().time;
  return std::min(odometry.front().time, sightings.front().time);
}

std::chrono::nanoseconds Recording::end() const {
  if (odometry.empty() && sightings.empty()) return {};
  if (odometry.empty()) return sightings.back().time;
  if (sightings.empty()) return odometry.back().time;
  return std::max(odometry.back().time, sightings.back().time);
}

std::optional<Eigen::Vector3d> Recording::truthAt(std::chrono::nanoseconds time) const {
  const auto after = std::lower_bound(
      truth_path.begin(), truth_path.end(), time,
      [](const TimedPose& pose, std::chrono::nanoseconds wanted) { return pose.time < wanted; });
  if (after == truth_path.end()) return std::nullopt;
  if (after->time == time) return after->pose;
  if (after == truth_path.begin()) return std::nullopt;
  const TimedPose& from = *std::prev(after);
  const double share = std::chrono::duration<double>(time - from.time) /
                       std::chrono::duration<double>(after->time - from.time);
  Eigen::Vector3d moved = after->pose - from.pose;
  moved[2] = wrapAngle(moved[2]);
  Eigen::Vector3d pose = from.pose + share * moved;
  pose[2] = wrapAngle(pose[2]);
  return pose;
}

void moveTruthIntoMap(Recording& recording) {
  if (recording.truth_path.empty()) return;
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
  if (recording.sightings.empty()) {
    throw std::runtime_error(path + ": expected sightings of features, found none");
  }
}

void addSighting(Recording& recording, std::chrono::nanoseconds time, const RangeBearing& seen) {
  auto& groups = recording.sightings;
  if (groups.empty() || groups.back().time != time) {
    groups.push_back({time, {}});
  } else {
    ++recording.equal_stamps;
  }
  groups.back().seen.push_back(seen);
}

}  // namespace slamscope::slam
