// SPDX-License-Identifier: MIT
#include "slam/audit/linearisation.hpp"

namespace slamscope::slam {

Means meansOf(const Snapshot& snapshot) {
  Means means;
  means.pose = snapshot.pose;
  means.features.reserve(snapshot.ids.size());
  for (std::size_t k = 0; k < snapshot.ids.size(); ++k) {
    means.features.emplace(snapshot.ids[k], snapshot.features[k]);
  }
  return means;
}

void LinearisationPoints::take(const SnapshotPtr& previous, const Snapshot& snapshot) {
  for (std::size_t k = 0; k < snapshot.ids.size(); ++k) {
    first_estimates.emplace(snapshot.ids[k], snapshot.features[k]);
  }
  if (snapshot.event == Event::remove) {
    std::erase_if(first_estimates,
                  [&](const auto& entry) { return !snapshot.indexOf(entry.first).has_value(); });
  }
  if (snapshot.event != Event::predict || !previous) return;
  if (after_prediction) earlier_prediction = after_prediction->pose;
  after_prediction = meansOf(snapshot);
  before_prediction = meansOf(*previous);
}

}  // namespace slamscope::slam
