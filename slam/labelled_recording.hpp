// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam/carried_ids.hpp"
#include "slam/map_builder.hpp"
#include "slam/recording.hpp"

namespace slamscope::slam {

/// What became of a recording's readings and of the ids they carried.
struct LabelledReadings {
  CarriedIds carried;
  MapCounters counters;
};

/// Gives sightings, in order, the ids in `labels` in place of their own; those of none (0) are
/// taken out and counted as ambiguous. As many labels as sightings, else std::out_of_range.
LabelledReadings relabel(Recording& recording, const std::vector<FeatureId>& labels);

}  // namespace slamscope::slam
