// SPDX-License-Identifier: MIT
#include "slam/audit/linearisation.hpp"

#include <algorithm>

namespace slamscope::slam {

namespace {

/// Keeps the memory that is there.
void note(const Snapshot& snapshot, std::optional<Means>& means) {
  if (!means) means.emplace();
  means->pose = snapshot.pose;
  means->ids = snapshot.ids;
  means->features = snapshot.features;
}

}  // namespace

std::optional<Eigen::Vector2d> Means::feature(FeatureId id) const {
  const auto found = std::find(ids.begin(), ids.end(), id);
  if (found == ids.end()) return std::nullopt;
  return features[static_cast<std::size_t>(found - ids.begin())];
}

void LinearisationPoints::take(const SnapshotPtr& previous, const Snapshot& snapshot) {
  const bool same_map = previous && previous->ids == snapshot.ids;
  for (std::size_t k = 0; k < snapshot.ids.size() && !same_map; ++k) {
    first_estimates.try_emplace(snapshot.ids[k], snapshot.features[k]);
  }
  if (snapshot.event == Event::remove) {
    std::erase_if(first_estimates,
                  [&](const auto& entry) { return !snapshot.indexOf(entry.first).has_value(); });
  }
  if (snapshot.event != Event::predict || !previous) return;
  if (after_prediction) earlier_prediction = after_prediction->pose;
  note(snapshot, after_prediction);
  note(*previous, before_prediction);
}

}  // namespace slamscope::slam
