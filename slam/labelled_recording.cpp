// SPDX-License-Identifier: MIT
#include "slam/labelled_recording.hpp"

#include <set>

namespace slamscope::slam {

LabelledReadings relabel(Recording& recording, const std::vector<FeatureId>& labels) {
  LabelledReadings result;
  std::set<FeatureId> features;
  std::size_t number = 0;
  for (Sightings& sightings : recording.sightings) {
    for (Sighting& sighting : sightings.seen) {
      const FeatureId label = labels.at(number++);
      if (label == 0) {
        ++result.counters.ambiguous;
      } else {
        result.carried.count(label, sighting.id);
        ++(features.insert(label).second ? result.counters.born : result.counters.paired);
      }
      sighting.id = label;
    }
    std::erase_if(sightings.seen, [](const Sighting& sighting) { return sighting.id == 0; });
  }
  result.counters.confirmed = result.counters.born;
  recording.ids_known = true;
  return result;
}

}  // namespace slamscope::slam
