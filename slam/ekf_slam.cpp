// SPDX-License-Identifier: MIT
#include "slam/ekf_slam.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>

namespace slamscope::slam {
namespace {

/// Quantile of χ² with two degrees of freedom.
double chiSquare2(double probability) {
  return -2.0 * std::log1p(-probability);
}

void requireFinite(const Observation& o) {
  if (o.z.allFinite() && o.R.allFinite()) return;
  throw std::invalid_argument("observation of feature " + std::to_string(o.id) +
                              " is not finite: z = (" + std::to_string(o.z[0]) + ", " +
                              std::to_string(o.z[1]) + ")");
}

std::vector<ObservationRecord> recordsOf(const Correction& correction, int size, bool jacobians) {
  std::vector<ObservationRecord> records;
  records.reserve(correction.observations.size());
  Eigen::Index row = 0;
  for (const LinearisedObservation& o : correction.observations) {
    records.push_back({o.id, o.z, o.innovation, correction.S.block<2, 2>(row, row), o.R,
                       jacobians ? o.H.dense(size) : Eigen::MatrixXd()});
    row += 2;
  }
  return records;
}

}  // namespace

EkfSlam::EkfSlam(const EkfOptions& options)
    : EkfSlam(options, std::make_unique<EkfEquations>(options.sensor)) {}

EkfSlam::EkfSlam(const EkfOptions& options, std::unique_ptr<EkfEquations> equations)
    : options_(options), equations_(std::move(equations)) {
  if (options.sensor == Sensor::unknown || equations_->sensor() != options.sensor) {
    throw std::invalid_argument("EkfSlam: the sensor is unknown or not the one of its equations");
  }
  if (options.gate_probability &&
      !(*options.gate_probability > 0.0 && *options.gate_probability < 1.0)) {
    throw std::invalid_argument("EkfSlam: gate probability " +
                                std::to_string(*options.gate_probability) + " is not in (0, 1)");
  }
  if (!options.initial_pose.allFinite() || !options.initial_covariance.allFinite()) {
    throw std::invalid_argument("EkfSlam: initial pose or covariance is not finite");
  }
  equations_->setThreads(options.threads);
  state_.x = options.initial_pose;
  state_.P = options.initial_covariance;
}

template <typename Fill>
void EkfSlam::announce(Event event, Fill fill) {
  if (wants(event)) {
    auto snapshot = std::make_shared<Snapshot>(makeSnapshot(event));
    fill(*snapshot);
    publish(snapshot);
  }
  ++sequence_;
}

void EkfSlam::start(std::chrono::nanoseconds time) {
  advance(time);
  announce(Event::initial, [](Snapshot&) {});
}

void EkfSlam::predict(std::chrono::nanoseconds time, const Motion& motion) {
  if (!motion.increment.allFinite() || !motion.M.allFinite()) {
    throw std::invalid_argument("the motion at " + std::to_string(time.count()) +
                                " ns is not finite");
  }
  advance(time);
  const Eigen::Matrix3d Q = equations_->predict(state_, motion);
  ++counters_.predictions;
  announce(Event::predict, [&](Snapshot& snapshot) {
    snapshot.control = motion.control;
    snapshot.Q = Q;
  });
}

const std::vector<FeatureId>& EkfSlam::update(std::span<const Observation> observations) {
  used_.clear();
  const std::size_t at_once = options_.update == UpdateMode::batch ? observations.size() : 1;
  for (std::size_t k = 0; k < observations.size(); k += at_once) {
    updateOnce(observations.subspan(k, at_once));
  }
  return used_;
}

/// Appends to `used_`.
void EkfSlam::updateOnce(std::span<const Observation> observations) {
  accepted_.clear();
  for (const Observation& o : observations) {
    requireFinite(o);
    if (!knows(o.id)) {
      throw std::invalid_argument("update with feature " + std::to_string(o.id) +
                                  ", which is not in the map");
    }
    if (passes(o)) accepted_.push_back(o);
  }
  if (accepted_.empty()) return;
  Correction correction = equations_->update(state_, accepted_);
  if (!correction.applied && dropUndefined(accepted_)) {
    correction = equations_->update(state_, accepted_);
  }
  if (correction.applied) {
    ++counters_.updates;
    counters_.observed += accepted_.size();
    for (const Observation& o : accepted_) used_.push_back(o.id);
    announce(Event::update, [&](Snapshot& snapshot) {
      for (const Observation& o : accepted_) snapshot.observed.push_back(o.id);
      snapshot.observations = recordsOf(correction, state_.size(), options_.record_jacobians);
    });
  } else {
    counters_.degenerate += accepted_.size();
  }
  equations_->reuse(std::move(correction));
}

bool EkfSlam::passes(const Observation& observation) {
  if (!options_.gate_probability) return true;
  const LinearisedObservation o = equations_->linearise(state_, observation);
  const Eigen::Matrix2d S = equations_->innovationCovariance(state_, o);
  const double squared_mahalanobis = o.innovation.dot(S.inverse() * o.innovation);
  // Written so that what is not a number passes: it is no outlier, the update looks at it.
  if (!(squared_mahalanobis > chiSquare2(*options_.gate_probability))) return true;
  ++counters_.gated_out;
  rejected_.push_back(observation.id);
  return false;
}

bool EkfSlam::dropUndefined(std::vector<Observation>& observations) {
  const auto undefined = [this](const Observation& observation) {
    const LinearisedObservation o = equations_->linearise(state_, observation);
    return !o.innovation.allFinite() || !o.H.H_v.allFinite() || !o.H.H_f.allFinite();
  };
  const std::size_t dropped = std::erase_if(observations, undefined);
  counters_.degenerate += dropped;
  return dropped > 0 && !observations.empty();
}

void EkfSlam::initialise(const Observation& observation) {
  requireFinite(observation);
  if (knows(observation.id)) {
    throw std::invalid_argument("initialise of feature " + std::to_string(observation.id) +
                                ", which is in the map already");
  }
  equations_->initialise(state_, observation);
  ++counters_.initialised;
  announce(Event::initialise, [&](Snapshot& snapshot) { snapshot.observed = {observation.id}; });
}

void EkfSlam::remove(FeatureId id) {
  const std::optional<int> row = state_.rowOf(id);
  if (!row) {
    throw std::invalid_argument("remove of feature " + std::to_string(id) +
                                ", which is not in the map");
  }
  state_.removeAt(*row);
  ++counters_.removed;
  announce(Event::remove, [](Snapshot&) {});
}

void EkfSlam::observe(std::chrono::nanoseconds time, std::span<const Observation> observations) {
  advance(time);
  known_.clear();
  fresh_.clear();
  for (const Observation& o : equations_->perceive(state_, observations)) {
    (knows(o.id) ? known_ : fresh_).push_back(o);
  }
  update(known_);
  observed_ = used_;
  known_.clear();  // from here on: second readings of features that are born in this very step
  for (const Observation& o : fresh_) {
    if (knows(o.id)) {
      known_.push_back(o);
    } else {
      initialise(o);
      observed_.push_back(o.id);
    }
  }
  update(known_);
  announce(Event::step, [&](Snapshot& snapshot) { snapshot.observed = observed_; });
}

void EkfSlam::step(std::chrono::nanoseconds time, const Motion& motion,
                   std::span<const Observation> observations) {
  predict(time, motion);
  observe(time, observations);
}

void EkfSlam::advance(std::chrono::nanoseconds time) {
  if (time_ && time < *time_) {
    throw std::invalid_argument("time goes back from " + std::to_string(time_->count()) +
                                " ns to " + std::to_string(time.count()) + " ns");
  }
  time_ = time;
  rejected_.clear();
}

Snapshot EkfSlam::makeSnapshot(Event event) const {
  Snapshot snapshot;
  snapshot.time = time();
  snapshot.sequence = sequence_;
  snapshot.event = event;
  snapshot.pose = state_.pose();
  snapshot.ids = state_.ids;
  snapshot.features.reserve(state_.ids.size());
  for (int row = 3; row < state_.size(); row += 2) {
    snapshot.features.emplace_back(state_.x.segment<2>(row));
  }
  snapshot.covariance = PackedCovariance::fromLower(state_.P);
  snapshot.asymmetry = equations_->asymmetry(state_);
  std::copy_if(tentative_.begin(), tentative_.end(), std::back_inserter(snapshot.tentative),
               [this](FeatureId id) { return knows(id); });
  snapshot.observed_given = true;
  snapshot.truth = truth_;
  return snapshot;
}

}  // namespace slamscope::slam
