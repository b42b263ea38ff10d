// SPDX-License-Identifier: MIT
#include "slam/run_order.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "slam/decimal_time.hpp"
#include "slam/jsonl.hpp"

namespace slamscope::slam {
namespace {

bool mayAdd(Event event) {
  return event == Event::initial || event == Event::initialise || event == Event::step;
}

bool mayRemove(Event event) {
  return event == Event::remove || event == Event::step;
}

[[noreturn]] void failIds(FeatureId id, std::string_view change, const Snapshot& next,
                          std::string_view events) {
  throw std::runtime_error("ids: feature " + std::to_string(id) + " " + std::string(change) +
                           " in a record of event " + std::string(eventName(next.event)) +
                           ", expected that of " + std::string(events) + " only");
}

/// Positions of the survivors must rise, unless the event moved them (a removal may fill the gap
/// with the last feature).
void checkIds(const Snapshot& last, const Snapshot& next) {
  if (last.ids == next.ids) return;
  std::unordered_map<FeatureId, std::size_t> before;
  for (std::size_t k = 0; k < last.ids.size(); ++k) before.emplace(last.ids[k], k);
  std::size_t survivors = 0;
  std::optional<FeatureId> displaced;
  std::size_t position = 0;
  for (const FeatureId id : next.ids) {
    const auto found = before.find(id);
    if (found == before.end()) {
      if (!mayAdd(next.event)) failIds(id, "appears", next, "initial, initialise or step");
      continue;
    }
    if (survivors++ != 0 && found->second < position) displaced = id;
    position = found->second;
  }
  const bool removed = survivors < last.ids.size();
  if (removed && !mayRemove(next.event)) {
    const auto gone = std::find_if(last.ids.begin(), last.ids.end(), [&](FeatureId id) {
      return std::find(next.ids.begin(), next.ids.end(), id) == next.ids.end();
    });
    failIds(*gone, "is gone", next, "remove or step");
  }
  if (displaced && !removed) {
    throw std::runtime_error("ids: expected the order of the record before, found feature " +
                             std::to_string(*displaced) + " in another place");
  }
}

}  // namespace

void RunOrder::take(const SnapshotPtr& next) {
  if (last_) {
    if (next->time < last_->time) {
      throw std::runtime_error("time: expected at least " + secondsText(last_->time) +
                               " s as in the record before, found " + secondsText(next->time) +
                               " s");
    }
    checkIds(*last_, *next);
    const bool whole_step = next->event == Event::step || next->event == Event::predict;
    if (next->time == last_->time && next->event == last_->event && whole_step) ++equal_stamps_;
  }
  last_ = next;
}

}  // namespace slamscope::slam
