// SPDX-License-Identifier: MIT
#pragma once

namespace slamscope::tracking::experiments {

struct TrackingTableOptions {
  int frames = 24;       ///< of each walk through the lab, painted picture by picture
  int trials = 1000;     ///< T8, T12; ten times as many for T10, four times for T9
  bool pictures = true;  ///< the lab's walks at all: minutes
};

/// The figures of the specification that tracking answers for: row, floor, aim, measured. Returns
/// how many floors are missed.
int printTrackingTable(const TrackingTableOptions& options);

}  // namespace slamscope::tracking::experiments
