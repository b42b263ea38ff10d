// SPDX-License-Identifier: MIT
#include "slam/run_recording.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "slam/first_estimates.hpp"

namespace slamscope::slam {
namespace {

using std::chrono::nanoseconds;

/// So many sightings of one id in a row outside the gate are no accident.
constexpr int kSuspicious = 5;

/// With hypotheses: puts the best one's labels into the recording.
std::optional<LabelledReadings> labelsByHypotheses(Recording& recording,
                                                   const RecordingRunOptions& options) {
  if (options.hypotheses.most == 0) return std::nullopt;
  if (options.association != Association::joint) {
    throw std::invalid_argument("hypotheses go with joint association, not with known or nearest");
  }
  HypothesisSearch search(recording, options.initial_sigma, options.hypotheses);
  return relabel(recording, search.run());
}

/// Whether the filter is told the features of its readings.
bool idsGiven(const RecordingRunOptions& options) {
  return options.association == Association::known || options.hypotheses.most > 0;
}

EkfOptions recordingFilter(const Recording& recording, const RecordingRunOptions& options) {
  if (!(options.sensor_sigma.minCoeff() > 0.0) || !(options.odometry_sigma.minCoeff() >= 0.0) ||
      !(options.initial_sigma.minCoeff() >= 0.0) || options.longest_prediction.count() <= 0) {
    throw std::invalid_argument(
        "RecordingRun: σ of the sensor must be above 0, other σ not negative");
  }
  const bool known = idsGiven(options);
  if (known && (!recording.ids_known || !recording.scans.empty())) {
    throw std::invalid_argument(recording.name +
                                ": features have no ids here, so their association can't be known; "
                                "take nearest or joint");
  }
  EkfOptions result;
  result.sensor = recording.sensor;
  result.update = options.update;
  if (known) result.gate_probability = options.gate_probability;
  result.initial_covariance = options.initial_sigma.cwiseAbs2().asDiagonal();
  result.record_jacobians = options.record_jacobians;
  return result;
}

std::unique_ptr<EkfEquations> recordingEquations(const Recording& recording,
                                                 const RecordingRunOptions& options) {
  if (options.first_estimates) return std::make_unique<FirstEstimates>(recording.sensor);
  return std::make_unique<EkfEquations>(recording.sensor);
}

std::string counted(std::uint64_t count, const std::string& what) {
  return std::to_string(count) + " " + what;
}

}  // namespace

RecordingRun::RecordingRun(Recording recording, const RecordingRunOptions& options)
    : recording_(std::move(recording)),
      options_(options),
      labels_(labelsByHypotheses(recording_, options_)),
      filter_(recordingFilter(recording_, options), recordingEquations(recording_, options)),
      dead_reckoning_(recording_, options.odometry_sigma) {
  if (!recording_.scans.empty()) front_end_.emplace(recording_.laser, options.laser);
  if (!idsGiven(options_)) {
    map_.emplace(filter_, options.association, options.gates, options.life);
  }
}

bool RecordingRun::step() {
  if (!started_) {
    started_ = true;
    publishTruth(recording_.start());
    filter_.start(recording_.start());
    return true;
  }
  const std::optional<nanoseconds> time = nextTime();
  if (!time) return false;
  predictTo(*time);
  if (*time == recording_.sensedAt(next_)) sense(next_++);
  return true;
}

std::optional<nanoseconds> RecordingRun::nextTime() const {
  if (!started_) return recording_.start();
  if (next_ == recording_.sensedCount()) return std::nullopt;
  return std::min(recording_.sensedAt(next_), filter_.time() + options_.longest_prediction);
}

double RecordingRun::progress() const {
  if (!started_) return 0.0;
  const std::size_t count = recording_.sensedCount();
  if (next_ == count) return 1.0;
  const double duration = seconds(recording_.sensedAt(count - 1) - recording_.start());
  return duration > 0.0 ? seconds(filter_.time() - recording_.start()) / duration : 1.0;
}

RunHeader RecordingRun::header() const {
  RunHeader header;
  header.sensor = recording_.sensor;
  header.robot = recording_.name;
  const bool own_noise = std::any_of(
      recording_.sightings.begin(), recording_.sightings.end(), [](const Sightings& group) {
        return std::any_of(group.seen.begin(), group.seen.end(),
                           [](const Sighting& seen) { return seen.R.has_value(); });
      });
  if (!own_noise && recording_.scans.empty()) {
    header.R = Eigen::Matrix2d(options_.sensor_sigma.cwiseAbs2().asDiagonal());
  }
  return header;
}

std::optional<MapCounters> RecordingRun::mapCounters() const {
  if (labels_) return labels_->counters;
  if (!map_) return std::nullopt;
  return map_->counters();
}

std::uint64_t RecordingRun::mispaired() const {
  if (labels_) return labels_->carried.mispaired();
  return map_ ? map_->carried().mispaired() : 0;
}

std::map<FeatureId, FeatureId> RecordingRun::hiddenNames() const {
  if (labels_) return labels_->carried.names();
  if (!map_) return {};
  std::map<FeatureId, FeatureId> names = map_->carried().names();
  std::erase_if(names, [this](const auto& named) { return !map_->confirmed(named.first); });
  return names;
}

std::vector<std::string> RecordingRun::remarks() const {
  std::vector<std::string> lines;
  for (const auto& [id, count] : most_rejected_) {
    lines.push_back("feature " + std::to_string(id) + ": " + std::to_string(count) +
                    " sightings in a row were far from where it stands; is its id used for another "
                    "place, or has it moved?");
  }
  if (!map_) return lines;
  const MapCounters& c = map_->counters();
  if (c.crowded > 0) {
    lines.push_back(counted(c.crowded,
                            "readings made no feature: too near to another one, or too many that "
                            "are tentative already"));
  }
  if (c.cut_searches > 0) {
    lines.push_back(counted(c.cut_searches,
                            "joint searches were cut short, the best pairings until then taken"));
  }
  return lines;
}

void RecordingRun::predictTo(nanoseconds time) {
  publishTruth(time);
  if (time > filter_.time()) filter_.predict(time, dead_reckoning_.between(filter_.time(), time));
}

void RecordingRun::sense(std::size_t index) {
  if (front_end_) {
    const LaserScan& scan = recording_.scans[index];
    map_->observe(scan.time, front_end_->observations(scan, dead_reckoning_.velocity()),
                  front_end_->view(scan));
    return;
  }
  const Sightings& sightings = recording_.sightings[index];
  if (map_) {
    map_->observe(sightings.time, observationsOf(sightings), limitedView());
    return;
  }
  filter_.observe(sightings.time, observationsOf(sightings));
  if (!idsHidden()) watchIds(sightings);
}

/// Notes ids whose sightings fall outside the gate time after time.
void RecordingRun::watchIds(const Sightings& sightings) {
  const auto& rejected = filter_.rejected();
  for (const Sighting& seen : sightings.seen) {
    int& in_a_row = rejected_in_a_row_[seen.id];
    const bool out = std::find(rejected.begin(), rejected.end(), seen.id) != rejected.end();
    in_a_row = out ? in_a_row + 1 : 0;
    if (in_a_row < kSuspicious) continue;
    int& most = most_rejected_[seen.id];
    most = std::max(most, in_a_row);
  }
}

std::vector<Observation> RecordingRun::observationsOf(const Sightings& sightings) const {
  std::vector<Observation> observations;
  observations.reserve(sightings.seen.size());
  const Eigen::Matrix2d R = options_.sensor_sigma.cwiseAbs2().asDiagonal();
  for (const Sighting& seen : sightings.seen) {
    observations.push_back({seen.id, seen.z, seen.R.value_or(R)});
  }
  return observations;
}

MapBuilder::View RecordingRun::limitedView() const {
  if (!options_.view) return {};
  return [limits = *options_.view, sensor = recording_.sensor](const Eigen::Vector2d& z,
                                                               const Eigen::Matrix2d& S) {
    const Eigen::Vector2d polar =
        sensor == Sensor::range_bearing ? z : Eigen::Vector2d(z.norm(), std::atan2(z.y(), z.x()));
    const double across = sensor == Sensor::range_bearing
                              ? std::sqrt(S(1, 1))
                              : std::sqrt(S.diagonal().maxCoeff()) / polar[0];
    return polar[0] + 2.0 * std::sqrt(S(0, 0)) < limits.range &&
           std::abs(polar[1]) + 2.0 * across < limits.half_angle;
  };
}

void RecordingRun::publishTruth(nanoseconds time) {
  if (!recording_.truth_in_map) return;
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  Truth truth;
  truth.pose = recording_.truthAt(time).value_or(Eigen::Vector3d::Constant(kUnknown));
  for (const auto& [id, feature] : recording_.truth_features) {
    if (idsHidden()) break;  // the map's numbers are not these ids
    truth.ids.push_back(id);
    truth.features.push_back(feature);
  }
  filter_.setTruth(std::move(truth));
}

}  // namespace slamscope::slam
