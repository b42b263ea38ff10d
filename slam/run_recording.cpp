// SPDX-License-Identifier: MIT
#include "slam/run_recording.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace slamscope::slam {
namespace {

using std::chrono::nanoseconds;

EkfOptions filterOptions(const RecordingRunOptions& options) {
  if (!(options.sensor_sigma.minCoeff() > 0.0) || !(options.odometry_sigma.minCoeff() >= 0.0) ||
      !(options.initial_sigma.minCoeff() >= 0.0) || options.longest_prediction.count() <= 0) {
    throw std::invalid_argument(
        "RecordingRun: σ of the sensor must be above 0, other σ not negative");
  }
  EkfOptions result;
  result.update = options.update;
  result.gate_probability = options.gate_probability;
  result.initial_covariance = options.initial_sigma.cwiseAbs2().asDiagonal();
  result.record_jacobians = options.record_jacobians;
  return result;
}

}  // namespace

RecordingRun::RecordingRun(Recording recording, const RecordingRunOptions& options)
    : recording_(std::move(recording)), options_(options), filter_(filterOptions(options)) {}

bool RecordingRun::step() {
  if (!started_) {
    started_ = true;
    publishTruth(recording_.start());
    filter_.start(recording_.start());
    return true;
  }
  if (next_sighting_ == recording_.sightings.size()) return false;
  const Sightings& next = recording_.sightings[next_sighting_];
  const nanoseconds latest = filter_.time() + options_.longest_prediction;
  if (next.time > latest) {
    predictTo(latest);
    return true;
  }
  predictTo(next.time);
  filter_.observe(next.time, observationsOf(next));
  ++next_sighting_;
  return true;
}

double RecordingRun::progress() const {
  if (!started_) return 0.0;
  if (next_sighting_ == recording_.sightings.size()) return 1.0;
  const double duration = seconds(recording_.sightings.back().time - recording_.start());
  return duration > 0.0 ? seconds(filter_.time() - recording_.start()) / duration : 1.0;
}

RunHeader RecordingRun::header() const {
  RunHeader header;
  header.sensor = Sensor::range_bearing;
  header.robot = recording_.name;
  const bool own_sigmas = std::any_of(
      recording_.sightings.begin(), recording_.sightings.end(), [](const Sightings& group) {
        return std::any_of(group.seen.begin(), group.seen.end(),
                           [](const RangeBearing& seen) { return seen.sigma.has_value(); });
      });
  if (!own_sigmas) {
    header.R = Eigen::Matrix2d(options_.sensor_sigma.cwiseAbs2().asDiagonal());
  }
  return header;
}

void RecordingRun::predictTo(nanoseconds time) {
  publishTruth(time);
  if (time > filter_.time()) filter_.predict(time, motionBetween(filter_.time(), time));
}

/// What entry number `entry` moved the robot between two times.
Eigen::Vector3d RecordingRun::entryMotion(std::size_t entry, nanoseconds from,
                                          nanoseconds to) const {
  const auto& entries = recording_.odometry;
  if (recording_.odometry_kind == Recording::Odometry::velocity) {
    const Eigen::Vector3d& velocity = entries[entry].motion;
    return arcIncrement({velocity[0], velocity[2]}, seconds(to - from));
  }
  const nanoseconds begin = entries[entry].time;
  const double length = seconds(entries[entry + 1].time - begin);
  const Eigen::Vector3d& moved = entries[entry + 1].motion;
  if (length == 0.0) return moved;
  return incrementBetween(seconds(from - begin) / length * moved,
                          seconds(to - begin) / length * moved);
}

/// All odometry between two times in one motion: increments composed, their noise by Jacobians.
/// The interval of entry k goes from its time to that of entry k + 1.
Motion RecordingRun::motionBetween(nanoseconds from, nanoseconds to) {
  const auto& entries = recording_.odometry;
  Motion total;
  for (; next_entry_ + 1 < entries.size() && entries[next_entry_].time <= to; ++next_entry_) {
    const nanoseconds begin = std::max(from, entries[next_entry_].time);
    const nanoseconds end = std::min(to, entries[next_entry_ + 1].time);
    const Eigen::Vector3d moved = entryMotion(next_entry_, begin, end);
    Eigen::Matrix3d F_x;
    Eigen::Matrix3d G_u;
    total.increment = movePose(total.increment, moved, &F_x, &G_u);
    total.M = F_x * total.M * F_x.transpose();
    if (!moved.isZero(0.0)) {
      const Eigen::Vector3d variance = seconds(end - begin) * options_.odometry_sigma.cwiseAbs2();
      total.M += G_u * variance.asDiagonal() * G_u.transpose();
    }
    if (entries[next_entry_ + 1].time > to) break;
  }
  total.control = total.increment;
  return total;
}

std::vector<Observation> RecordingRun::observationsOf(const Sightings& sightings) const {
  std::vector<Observation> observations;
  observations.reserve(sightings.seen.size());
  for (const RangeBearing& seen : sightings.seen) {
    const Eigen::Vector2d sigma = seen.sigma.value_or(options_.sensor_sigma);
    observations.push_back({seen.id, {seen.range, seen.bearing}, sigma.cwiseAbs2().asDiagonal()});
  }
  return observations;
}

void RecordingRun::publishTruth(nanoseconds time) {
  if (!recording_.truth_in_map) return;
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  Truth truth;
  truth.pose = recording_.truthAt(time).value_or(Eigen::Vector3d::Constant(kUnknown));
  for (const auto& [id, feature] : recording_.truth_features) {
    truth.ids.push_back(id);
    truth.features.push_back(feature);
  }
  filter_.setTruth(std::move(truth));
}

}  // namespace slamscope::slam
