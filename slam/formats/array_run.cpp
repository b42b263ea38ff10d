// SPDX-License-Identifier: MIT
#include "slam/formats/array_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "slam/jsonl.hpp"

namespace slamscope::slam {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kMostSeconds = 9.2e9;           // of 64-bit nanoseconds
constexpr double kLargestId = 9007199254740992;  // 2^53: what a double counts up to

[[noreturn]] void failAt(const std::string& field, const std::string& expected,
                         const std::string& found) {
  throw std::runtime_error(field + ": expected " + expected + ", found " + found);
}

std::string number(double value) {
  std::string text = std::to_string(value);
  if (text.find('.') != text.npos) text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

bool isNone(double id) {
  return std::isnan(id) || id < 0.0;
}

FeatureId idOf(double value, const std::string& field) {
  if (!(value >= 0.0 && value <= kLargestId) || value != std::floor(value)) {
    failAt(field, "whole numbers from 0 on", number(value));
  }
  return static_cast<FeatureId>(value);
}

void checkDistinct(std::vector<FeatureId> ids) {
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end()) failAt("ids", "each id once", std::to_string(*twice) + " twice");
}

Event eventOf(const std::string& word) {
  std::string known;
  for (int k = 0; k <= static_cast<int>(Event::step); ++k) {
    const auto event = static_cast<Event>(k);
    if (word == eventName(event)) return event;
    known.push_back(' ');
    known.append(eventName(event));
  }
  failAt("event", "one of" + known, '"' + word + '"');
}

/// N, from x or else from P.
std::size_t stateSize(std::span<const double> x, bool has_x, std::span<const double> P) {
  const auto root = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(P.size()))));
  const std::size_t size = has_x ? x.size() : root;
  if (size < 3 || size % 2 == 0) {
    failAt(has_x ? "x" : "P", "3 + 2 numbers a feature (x, y, heading, then x, y of each)",
           std::to_string(size));
  }
  if (P.size() != size * size && (P.size() != size || !has_x)) {
    const std::string side = std::to_string(size);
    failAt("P", side + "×" + side + (has_x ? " as x has " + side + " numbers" : std::string()),
           std::to_string(P.size()) + " numbers");
  }
  return size;
}

void checkCount(const std::string& path, const std::string& field, std::size_t found,
                std::size_t expected) {
  if (found == 0 || found == expected) return;
  throw std::runtime_error(path + ": " + field + ": expected " + std::to_string(expected) +
                           ", one a step, found " + std::to_string(found));
}

}  // namespace

ArrayRun::ArrayRun(std::string path, RunArrays arrays)
    : path_(std::move(path)), arrays_(std::move(arrays)) {
  checkCount(path_, "t", arrays_.times.size(), arrays_.steps);
  checkCount(path_, "event", arrays_.events.size(), arrays_.steps);
  if (arrays_.steps == 0) throw std::runtime_error(path_ + ": expected steps, found none");
  header_.means_known = arrays_.x != nullptr;
  const bool counted = arrays_.times.empty();
  const bool placed = !arrays_.ids && arrays_.names.empty();
  if (!counted && !placed) return;
  std::string assumed = path_ + ": ";
  if (counted) assumed.append("no times (t): the number of the step stands for seconds");
  if (counted && placed) assumed.append("; ");
  if (placed) assumed.append("no ids: features are called 1, 2, … by their place in the state");
  arrays_.warnings.push_back(std::move(assumed));
}

SnapshotPtr ArrayRun::next() {
  if (step_ == arrays_.steps) {
    finish();
    return nullptr;
  }
  try {
    SnapshotPtr snapshot = read();
    order_.take(snapshot);
    ++step_;
    return snapshot;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path_ + ": record " + std::to_string(step_) + ": " + error.what());
  }
}

SnapshotPtr ArrayRun::read() {
  auto snapshot = std::make_shared<Snapshot>();
  const double time = arrays_.times.empty() ? static_cast<double>(step_) : arrays_.times[step_];
  if (!(std::abs(time) < kMostSeconds)) failAt("t", "a finite number of seconds", number(time));
  snapshot->time = std::chrono::nanoseconds(std::llround(1e9 * time));
  snapshot->sequence = step_;
  if (!arrays_.events.empty()) snapshot->event = eventOf(arrays_.events[step_]);

  const std::span<const double> x = arrays_.x ? arrays_.x->next() : std::span<const double>();
  const std::span<const double> P = arrays_.P->next();
  const std::size_t size = stateSize(x, arrays_.x != nullptr, P);
  const std::vector<int> places = readIds(*snapshot, x, P, size);

  std::vector<std::size_t> rows{0, 1, 2};
  for (const int place : places) {
    const auto row = static_cast<std::size_t>(Snapshot::row(place));
    rows.insert(rows.end(), {row, row + 1});
    snapshot->features.emplace_back(x.empty() ? kNan : x[row], x.empty() ? kNan : x[row + 1]);
  }
  snapshot->pose = x.empty() ? Eigen::Vector3d::Constant(kNan) : Eigen::Vector3d(x[0], x[1], x[2]);
  const int kept = static_cast<int>(rows.size());
  if (P.size() == size) {
    snapshot->diagonal_only = true;
    snapshot->covariance = PackedCovariance(kept);
    for (int k = 0; k < kept; ++k)
      snapshot->covariance(k, k) = P[rows[static_cast<std::size_t>(k)]];
  } else {
    part_.clear();
    for (const std::size_t row : rows) {
      for (const std::size_t col : rows) part_.push_back(P[row * size + col]);
    }
    double asymmetry = 0.0;
    snapshot->covariance = PackedCovariance::fromFull(kept, part_, asymmetry);
    snapshot->asymmetry = asymmetry;
  }
  readObserved(*snapshot, places, (size - 3) / 2);
  readTruth(*snapshot);
  return snapshot;
}

std::vector<int> ArrayRun::readIds(Snapshot& snapshot, std::span<const double> x,
                                   std::span<const double> P, std::size_t size) {
  const std::size_t all = (size - 3) / 2;
  std::vector<int> places;
  if (!arrays_.ids) {
    places = places_.find(x, P, size);
    const bool named = !arrays_.names.empty();
    if (named && arrays_.names.size() < all) {
      failAt("ids", std::to_string(all) + ", one a feature", std::to_string(arrays_.names.size()));
    }
    for (const int place : places) {
      snapshot.ids.push_back(named ? idOf(arrays_.names[static_cast<std::size_t>(place)], "ids")
                                   : static_cast<FeatureId>(place) + 1);
    }
  } else {
    const std::span<const double> ids = arrays_.ids->next();
    for (std::size_t k = 0; k < std::max(ids.size(), all); ++k) {
      const int place = static_cast<int>(k);
      const bool padding = k >= all || isPadding(x, P, size, place);
      const bool none = k >= ids.size() || isNone(ids[k]) || (ids[k] == 0.0 && padding);
      if (none && padding) continue;
      if (none || k >= all) {
        failAt("ids",
               none ? "an id for the feature in place " + std::to_string(k + 1)
                    : std::to_string(all) + " at most, one a feature",
               none ? "none" : std::to_string(ids.size()));
      }
      snapshot.ids.push_back(idOf(ids[k], "ids"));
      places.push_back(place);
    }
  }
  checkDistinct(snapshot.ids);
  return places;
}

void ArrayRun::readObserved(Snapshot& snapshot, const std::vector<int>& places, std::size_t all) {
  if (!arrays_.observed) return;
  const std::span<const double> read = arrays_.observed->next();
  snapshot.observed_given = true;
  if (!arrays_.observed_is_mask) {
    for (const double id : read) {
      if (!isNone(id)) snapshot.observed.push_back(idOf(id, "observed"));
    }
    return;
  }
  if (read.size() < all) {
    failAt("observed", std::to_string(all) + " truth values, one a feature",
           std::to_string(read.size()));
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (read[static_cast<std::size_t>(places[k])] != 0.0) {
      snapshot.observed.push_back(snapshot.ids[k]);
    }
  }
}

void ArrayRun::readTruth(Snapshot& snapshot) {
  if (!arrays_.truth) return;
  const std::span<const double> pose = arrays_.truth->next();
  if (pose.size() != 3)
    failAt("true", "3 numbers a step (x, y, heading)", number(double(pose.size())));
  snapshot.truth = Truth{{pose[0], pose[1], pose[2]}, {}, {}};
}

void ArrayRun::finish() {
  if (const auto count = order_.equalStamps(); count != 0 && !order_.empty()) {
    arrays_.warnings.push_back(path_ + ": " + std::to_string(count) +
                               " records have the same time as the one before");
    order_.restart();  // said once, however often the end is asked for
  }
}

}  // namespace slamscope::slam
