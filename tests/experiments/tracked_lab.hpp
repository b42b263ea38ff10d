// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tracking/head_tracker.hpp"
#include "tracking/stereo_lab.hpp"

namespace slamscope::tracking::experiments {

/// What came of tracking a head by the lab's pictures, from pixels to overlay.
struct TrackedLab {
  std::vector<double> overlay_px;  ///< points of the floor: drawn against where they truly are
  std::vector<double>
      disparity_px;  ///< the same points: error of the difference of both eyes' rows
  std::vector<Eigen::Isometry3d> T_world_head;  ///< found, by frame
  std::vector<double> find_ms, track_ms;  ///< of a frame of one eye; of a pair; processor's time
  double first_ms = 0;                    ///< from the first pair of pictures to a pose
  int frames = 0, tracked = 0;
  int least_tags = 1000;
};

/// Tracks `frames` pairs of pictures; errors count from the fourth on.
[[nodiscard]] TrackedLab trackLab(const StereoLabOptions& options, int frames);

/// RMS of the poses about their mean: degrees and metres.
struct Jitter {
  double degrees = 0, metres = 0;
};
[[nodiscard]] Jitter jitterOf(const std::vector<Eigen::Isometry3d>& poses);

/// The value that a part (0..1) of them stays below; 1e9 of none.
[[nodiscard]] double quantileOf(std::vector<double> values, double part);

}  // namespace slamscope::tracking::experiments
