// SPDX-License-Identifier: MIT
#include "slam/hypothesis_search.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "slam/audit/chi_square.hpp"

namespace slamscope::slam {
namespace {

using std::chrono::nanoseconds;

/// Predictions over longer times would take a turn of many radians for its sum.
constexpr nanoseconds kLongestHypothesisStep = std::chrono::seconds(1);

/// m; nearer, a strip of floor as wide as its range would be none.
constexpr double kLeastRange = 0.01;

Sensor rangeBearingOf(const Recording& recording) {
  if (recording.sensor != Sensor::range_bearing || !recording.scans.empty()) {
    throw std::invalid_argument(recording.name +
                                ": hypotheses are for sightings of range and bearing");
  }
  return recording.sensor;
}

const HypothesisOptions& checkedHypotheses(const HypothesisOptions& options) {
  const bool positive = options.most > 0 && options.fresh_density > 0.0 &&
                        options.view.range > 0.0 && options.view.half_angle > 0.0 &&
                        options.same_place > 0.0 && options.confirm_after > 0;
  const bool shares = options.gate_probability > 0.0 && options.gate_probability < 1.0 &&
                      options.least_odds > 0.0 && options.least_odds < 1.0;
  if (!positive || !shares || !(options.turn_sigma >= 0.0)) {
    throw std::invalid_argument(
        "hypotheses: number, density, view, sigmas and readings must be above 0, gate and odds "
        "between 0 and 1");
  }
  return options;
}

/// Names in order of appearance, of what was read often enough.
std::vector<FeatureId> renumbered(const std::vector<FeatureId>& labels, int confirm_after) {
  std::map<FeatureId, int> count;
  for (const FeatureId label : labels) ++count[label];
  std::map<FeatureId, FeatureId> names{{0, 0}};
  std::vector<FeatureId> result;
  for (const FeatureId label : labels) {
    const bool enough = label != 0 && count[label] >= confirm_after;
    if (enough) names.try_emplace(label, names.size());
    result.push_back(enough ? names[label] : 0);
  }
  return result;
}

}  // namespace

HypothesisSearch::HypothesisSearch(const Recording& recording, const Eigen::Vector3d& initial_sigma,
                                   const HypothesisOptions& options)
    : recording_(recording),
      options_(checkedHypotheses(options)),
      equations_(rangeBearingOf(recording)),
      error_(options.error),
      dead_reckoning_(recording, options.odometry_sigma),
      gate_(chiSquareQuantile(1.0 - options.gate_probability, 2.0)),
      drop_(-std::log(options.least_odds)),
      hypotheses_{Hypothesis::atOrigin(initial_sigma)},
      time_(recording.start()) {}

std::vector<FeatureId> HypothesisSearch::run() {
  for (const Sightings& sightings : recording_.sightings) {
    predictTo(sightings.time);
    for (const Sighting& sighting : sightings.seen) read(sighting, sightings.time);
    for (Hypothesis& hypothesis : hypotheses_) hypothesis.endTime();
    const std::size_t before_joins = hypotheses_.size();
    for (std::size_t k = 0; k < before_joins; ++k) addJoins(k);
    keepBest();
  }
  return renumbered(hypotheses_.front().labels(number_), options_.confirm_after);
}

void HypothesisSearch::predictTo(nanoseconds time) {
  while (time_ < time) {
    const nanoseconds next = std::min(time, time_ + kLongestHypothesisStep);
    Motion motion = dead_reckoning_.between(time_, next);
    motion.M(2, 2) += options_.turn_sigma * options_.turn_sigma * std::abs(motion.increment[2]);
    for (Hypothesis& hypothesis : hypotheses_) equations_.predict(hypothesis.state, motion);
    time_ = next;
  }
  for (Hypothesis& hypothesis : hypotheses_) hypothesis.seen_now.clear();
}

/// Forks are scored first, and only those become hypotheses that are likely enough.
void HypothesisSearch::read(const Sighting& sighting, nanoseconds time) {
  const Eigen::Matrix2d R = sighting.R.value_or(error_.covariance(sighting.z[0]));
  const Reading reading{number_++, time, {++last_name_, sighting.z, R}};
  forks_.clear();
  in_view_.assign(hypotheses_.size(), {});
  for (std::size_t k = 0; k < hypotheses_.size(); ++k) addForks(k, reading);
  std::stable_sort(forks_.begin(), forks_.end(),
                   [](const Fork& a, const Fork& b) { return a.score > b.score; });
  std::vector<Hypothesis> children;
  for (const Fork& fork : forks_) {
    const bool enough = children.size() == static_cast<std::size_t>(options_.most);
    if (enough || !(fork.score > forks_.front().score - drop_)) break;
    children.push_back(child(fork, reading));
  }
  hypotheses_ = std::move(children);
}

/// Scores are relative to "of a new feature", whose density over readings is λ × range.
void HypothesisSearch::addForks(std::size_t parent, const Reading& reading) {
  const Hypothesis& hypothesis = hypotheses_[parent];
  const auto& [name, z, R] = reading.observation;
  const std::vector<ExpectedReading> expected =
      expectedReadings(hypothesis.state, equations_.sensor());
  std::vector<std::size_t> unseen;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    if (hypothesis.sawNow(hypothesis.state.ids[k])) continue;
    unseen.push_back(k);
    if (expected[k].z[0] < options_.view.range &&
        std::abs(expected[k].z[1]) < options_.view.half_angle) {
      in_view_[parent].push_back(k);
    }
  }
  const double choices = std::max(1.0, static_cast<double>(in_view_[parent].size()));
  const double width = std::max(kLeastRange, std::abs(z[0]));
  const double fresh = std::log(options_.fresh_density * width * choices);
  for (const std::size_t k : unseen) {
    const Eigen::Vector2d innovation = observationDifference(equations_.sensor(), z, expected[k].z);
    if (!inGate(innovation, expected[k].HPHt + R)) continue;
    const FeatureMemory& memory = hypothesis.memories[k];
    const double likelihood = error_.logLikelihood(
        {innovation, expected[k].HPHt, R, memory.last_error, seconds(reading.time - memory.last)});
    forks_.push_back({parent, static_cast<int>(k), hypothesis.score + likelihood - fresh});
  }
  forks_.push_back({parent, Matches::kFresh, hypothesis.score});
}

bool HypothesisSearch::inGate(const Eigen::Vector2d& innovation, const Eigen::Matrix2d& S) const {
  return innovation.dot(S.inverse() * innovation) < gate_;
}

Hypothesis HypothesisSearch::child(const Fork& fork, const Reading& reading) {
  Hypothesis child = hypotheses_[fork.parent];
  child.score = fork.score;
  if (fork.feature == Matches::kFresh) {
    if (child.state.featureCount() == kMostFeatures) {
      throw std::runtime_error(recording_.name + ": more than " + std::to_string(kMostFeatures) +
                               " features, too many for hypotheses");
    }
    child.begin(equations_, reading);
    return child;
  }
  const auto choices = static_cast<double>(in_view_[fork.parent].size());
  for (const std::size_t k : in_view_[fork.parent]) {
    if (choices > 1.0) child.memories[k].choice_cost += std::log(choices / (choices - 1.0));
  }
  const auto index = static_cast<std::size_t>(fork.feature);
  Reading correcting = reading;
  correcting.observation.R = error_.correctionCovariance(
      reading.observation.R, seconds(reading.time - child.memories[index].last));
  child.pair(equations_, index, correcting);
  return child;
}

/// Features that were seen now, each with every other that it was never seen beside: how much
/// likelier it is that they are one, than that there are two and one of them new when it was first
/// seen.
void HypothesisSearch::addJoins(std::size_t parent) {
  for (const FeatureId seen : std::vector<FeatureId>(hypotheses_[parent].seen_now)) {
    const std::vector<FeatureId> ids = hypotheses_[parent].state.ids;
    const auto a = static_cast<std::size_t>(std::find(ids.begin(), ids.end(), seen) - ids.begin());
    for (std::size_t b = 0; b < ids.size(); ++b) {
      const Hypothesis& two = hypotheses_[parent];
      if (a == b || two.sawTogether(seen, ids[b])) continue;
      const std::size_t stays = ids[a] < ids[b] ? a : b;
      const std::size_t goes = stays == a ? b : a;
      Hypothesis::Distance apart = two.distance(stays, goes);
      apart.covariance += options_.same_place * options_.same_place * Eigen::Matrix2d::Identity();
      if (!inGate(apart.mean, apart.covariance)) continue;
      Hypothesis one = two;
      one.score += logNormal(apart.mean, apart.covariance) - std::log(options_.fresh_density) +
                   two.memories[goes].choice_cost;
      if (!(one.score > hypotheses_.front().score - drop_)) continue;
      one.join(stays, goes, apart);
      hypotheses_.push_back(std::move(one));
    }
  }
}

void HypothesisSearch::keepBest() {
  std::stable_sort(hypotheses_.begin(), hypotheses_.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.score > b.score; });
  std::vector<Hypothesis> kept;
  const double least = hypotheses_.front().score - drop_;
  for (Hypothesis& hypothesis : hypotheses_) {
    const bool enough = kept.size() == static_cast<std::size_t>(options_.most);
    if (enough || !(hypothesis.score > least)) break;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Hypothesis& better) {
      return alike(better, hypothesis, options_.likeness);
    });
    if (!known) kept.push_back(std::move(hypothesis));
  }
  hypotheses_ = std::move(kept);
}

}  // namespace slamscope::slam
