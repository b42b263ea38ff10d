// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>

namespace slamscope::slam {

/// The same angle in (−π, π] (rad). The only place where angles are wrapped.
[[nodiscard]] inline double wrapAngle(double angle) {
  if (angle > -std::numbers::pi && angle <= std::numbers::pi) return angle;  // nearly always
  const double wrapped = std::remainder(angle, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

}  // namespace slamscope::slam
