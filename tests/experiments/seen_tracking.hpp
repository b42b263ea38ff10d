// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace slamscope::tracking::experiments {

// Many trials on corners that OpenCV projects and noise moves: what the lab's pictures would take
// days for.

/// T8: mean squared Mahalanobis distances of pose (6 degrees of freedom) and overlay pixel (2).
struct Consistency {
  double pose = 0, overlay = 0;
};
[[nodiscard]] Consistency consistencyOf(int runs);

/// T9: part of the frames that are tracked, and rightly, with 60 % of the tags hidden at random.
[[nodiscard]] double trackedWithMostHidden(int frames);

/// T10: single-camera trials that go from many tags to a lone one.
struct LoneTags {
  int trials = 0, published = 0, wrong = 0, ambiguous = 0;
};
[[nodiscard]] LoneTags loneTags(int trials);

/// T11: layouts with one tag moved by 1 cm, two swapped, one of another size; a tag seen twice.
struct SpoiltLayouts {
  int trials = 0, rejected_at_once = 0, named = 0, others_named = 0;
};
[[nodiscard]] SpoiltLayouts spoiltLayouts(int places);

/// T12 and its note: after gaps without tags.
struct Relocks {
  int trials = 0, in_one_frame = 0, within_covariance = 0;
  std::vector<double> jump_px;  ///< of the overlay, after gaps of up to 0.1 s
};
[[nodiscard]] Relocks relocks(int trials, bool turning);

}  // namespace slamscope::tracking::experiments
