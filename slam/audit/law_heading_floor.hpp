// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "slam/audit/outcome.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// heading-floor: P_θθ(k) ≥ 0.99 P_θθ(0). With relative sensing nothing is ever learned of the
/// map's heading as a whole, which is the robot's heading at the start (Bailey et al., "Consistency
/// of the EKF-SLAM algorithm", IROS 2006): linearisation, correct code does it readily. Residual:
/// loss, 1 − P_θθ(k)/P_θθ(0). Tolerance 0.01 + rounding.
class HeadingFloorLaw {
 public:
  [[nodiscard]] Outcome check(const Snapshot& snapshot, double noise);

 private:
  std::optional<double> at_start_;
};

}  // namespace slamscope::slam
