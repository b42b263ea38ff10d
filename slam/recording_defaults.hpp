// SPDX-License-Identifier: MIT
#pragma once

#include "slam/run_recording.hpp"

namespace slamscope::slam {

/// Options to start with, by what was recorded: odometry of a slow robot indoors, of a car
/// outdoors, or none; a laser or sightings; with ids or, where `association` is nearest or joint,
/// without. Without ids the noise of sightings is taken wider, because a reading of a close
/// neighbour is an error too, and gates let more through.
/// With so many `hypotheses` noise is what it is with ids, for the filter is told them.
[[nodiscard]] RecordingRunOptions usualOptions(const Recording& recording, Association association,
                                               int hypotheses = 0);

}  // namespace slamscope::slam
