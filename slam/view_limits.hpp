// SPDX-License-Identifier: MIT
#pragma once

namespace slamscope::slam {

/// What a sensor of sightings surely sees: out to `range` (m), `half_angle` (rad) left and right.
struct ViewLimits {
  double range = 0.0;
  double half_angle = 0.0;
};

}  // namespace slamscope::slam
