// SPDX-License-Identifier: MIT
#include "slam/audit/law_heading_floor.hpp"

#include <cmath>

namespace slamscope::slam {

Outcome HeadingFloorLaw::check(const Snapshot& snapshot, double noise) {
  const double variance = snapshot.covariance(2, 2);
  if (!at_start_) at_start_ = variance;
  if (!(*at_start_ > 0.0))
    return Outcome::notCheckable("the heading is exactly known at the start");
  Outcome outcome = Outcome::of(1.0 - variance / *at_start_, 0.01 + 2.0 * noise);
  if (!outcome.violated()) return outcome;
  outcome.amount =
      "the heading's sigma falls below that of the start, which relative sensing can't";
  outcome.evidence.push_back(
      {"sigma of the heading", std::sqrt(std::max(variance, 0.0)), std::sqrt(*at_start_)});
  return outcome;
}

}  // namespace slamscope::slam
