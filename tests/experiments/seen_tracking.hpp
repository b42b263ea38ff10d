// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tracking/head_path.hpp"

namespace slamscope::tracking::experiments {

// Many trials on corners that OpenCV projects and noise moves: what the lab's pictures would take
// days for.

/// T9: part of the frames that are tracked, and rightly, with 60 % of the tags hidden at random.
[[nodiscard]] double trackedWithMostHidden(int frames);

/// T10: single-camera trials that go from many tags to a lone one.
struct LoneTags {
  int trials = 0, published = 0, wrong = 0, ambiguous = 0;
};
[[nodiscard]] LoneTags loneTags(int trials);

/// T11: layouts with one tag moved by 1 cm, two swapped, one of another size, and
/// ten frames through which that tag stays in view.
struct SpoiltLayouts {
  int trials = 0, rejected_at_once = 0, named = 0, others_named = 0;
};
[[nodiscard]] SpoiltLayouts spoiltLayouts(int places);

/// T12 and its note: after gaps without tags.
struct Relocks {
  int trials = 0, in_one_frame = 0, within_covariance = 0;
  std::vector<double> jump_px;  ///< of the overlay, after gaps of up to 0.1 s
};
[[nodiscard]] Relocks relocks(int trials, const HeadPath& head);

/// Looks from side to side (`angle`, rad) with minimum-jerk turns (Flash and Hogan, 1985) of this
/// peak rate (rad/s), resting 0.2 to 0.8 s between them: nobody can know when the next one begins.
[[nodiscard]] HeadPath glancingHead(double peak_rate, double angle);

}  // namespace slamscope::tracking::experiments
