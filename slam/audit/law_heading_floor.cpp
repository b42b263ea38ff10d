// SPDX-License-Identifier: MIT
#include "slam/audit/law_heading_floor.hpp"

#include <cmath>

#include "slam/audit/law_initialise.hpp"

namespace slamscope::slam {
namespace {

/// A map without an update in it: the heading's variance later on may lawfully fall below that of a
/// record in the middle of a run.
bool isStart(const Snapshot& snapshot, double noise) {
  if (snapshot.event == Event::initial) return true;
  for (int i = 0; i < snapshot.featureCount(); ++i) {
    if (snapshot.diagonal_only || !looksInitialised(snapshot, i, noise)) return false;
  }
  return true;
}

}  // namespace

Outcome HeadingFloorLaw::check(const Snapshot& snapshot, double noise) {
  const double variance = snapshot.covariance(2, 2);
  if (!at_start_) at_start_ = isStart(snapshot, noise) ? variance : 0.0;
  if (!(*at_start_ > 0.0))
    return Outcome::notCheckable(
        "the heading is exactly known at the start, or the log starts later");
  Outcome outcome = Outcome::of(1.0 - variance / *at_start_, 0.01 + 2.0 * noise);
  if (!outcome.violated()) return outcome;
  outcome.amount =
      "the heading's sigma falls below that of the start, which relative sensing can't";
  outcome.show("sigma of the heading", std::sqrt(std::max(variance, 0.0)), std::sqrt(*at_start_),
               LawfulIs::at_least);
  return outcome;
}

}  // namespace slamscope::slam
