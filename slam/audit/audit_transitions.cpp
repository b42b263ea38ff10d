// SPDX-License-Identifier: MIT
// Which laws are asked of which kind of transition.
#include <algorithm>

#include "slam/audit/audit_state.hpp"
#include "slam/audit/innovation_estimate.hpp"
#include "slam/audit/law_initialise.hpp"
#include "slam/audit/law_jacobian_given.hpp"
#include "slam/audit/law_map_still.hpp"
#include "slam/audit/law_motion.hpp"
#include "slam/audit/law_range.hpp"
#include "slam/audit/law_sensor_noise.hpp"
#include "slam/audit/law_shrink.hpp"

namespace slamscope::slam {
namespace {

constexpr const char* kExtraStates = "further states stand in the state vector";

/// Every blamed feature stands in the map as one that was initialised in this very record: removed
/// and seen again under its old id.
bool initialisedAgain(const Transition& t, const Outcome& outcome) {
  if (outcome.blame.empty()) return false;
  return std::all_of(outcome.blame.begin(), outcome.blame.end(), [&](const Blame& b) {
    const std::optional<int> index = t.after->indexOf(b.feature);
    return index && looksInitialised(*t.after, *index, t.noise);
  });
}

}  // namespace

void Audit::State::judgeTransition(const Transition& t) {
  const Snapshot& s = *t.after;
  checked = false;
  const bool same_map = t.shared == s.featureCount();
  if (s.event == Event::predict && same_map && comparable()) {
    judgePrediction(t);
    return;
  }
  if (s.event == Event::initialise && comparable()) {
    judgeInitialisation(t);
    return;
  }
  if (!comparable()) {
    const bool moves = s.event == Event::predict || s.event == Event::initialise;
    if (!moves) judgeShrink(t, true, true);
  } else if (s.event == Event::update && same_map) {
    judgeUpdate(t);
  } else {
    judgeStep(t);
  }
  if (checked) ++corrections_checked;
}

void Audit::State::judgePrediction(const Transition& t) {
  const Snapshot& s = *t.after;
  Outcome still;
  for (const Allow allow : {Allow::moving_features, Allow::robocentric, Allow::inflation}) {
    if (allows(allow)) still = declaredAway(allow);
  }
  if (still.kind == Outcome::Kind::not_applicable) still = checkMapStill(t);
  note(Law::map_still, still, s);
  // What a form that re-computes P loses there, it loses everywhere.
  if (still.checked() && !still.violated() && !t.rounded) {
    arithmetic = std::max(arithmetic, std::min(1e-7, 10.0 * still.residual));
  }
  if (!s.extra.empty()) {
    note(Law::motion, Outcome::notCheckable(kExtraStates), s);
    return;
  }
  if (allows(Allow::robocentric) || allows(Allow::fej)) {
    note(Law::motion, declaredAway(allows(Allow::fej) ? Allow::fej : Allow::robocentric), s);
    return;
  }
  const MotionCheck motion = checkMotion(t, points);
  note(Law::motion, motion.outcome, s);
  hint(motion.allow);
  if (motion.outcome.violated() || allows(Allow::inflation)) return;
  if (allow_hints.contains("fej")) {
    note(Law::process_noise, Outcome::notCheckable("F is not taken at the mean (--allow fej)"), s);
    return;
  }
  const LawTally& tally = tallies[static_cast<std::size_t>(Law::motion)];
  const bool whole =
      !motion.nearly && !motion.allow && tally.violations() == 0 && tally.checked() > 0;
  note(Law::process_noise, checkProcessNoise(t, header.Q, whole), s);
  if (whole) unrotated.take(processNoiseOf(t), t.before->pose[2]);
}

void Audit::State::judgeShrink(const Transition& t, bool map_only, bool everything) {
  for (const Allow allow : {Allow::inflation, Allow::robocentric, Allow::moving_features}) {
    if (allows(allow) && (map_only || allow == Allow::inflation)) {
      note(Law::shrink, declaredAway(allow), *t.after);
      return;
    }
  }
  const Outcome shrink = checkShrink(t, map_only, everything);
  if (map_only && options.means_known && !diagonal_only && shrink.violated() &&
      initialisedAgain(t, shrink)) {
    return;
  }
  note(Law::shrink, shrink, *t.after);
}

void Audit::State::judgeUpdate(const Transition& t) {
  const Snapshot& s = *t.after;
  if (!s.extra.empty()) {
    note(Law::support, Outcome::notCheckable(kExtraStates), s);
    judgeShrink(t, false, true);
    noteInnovation(estimateStepInnovation(t), s);
    return;
  }
  if (lawful.recognised()) {
    judgeLawfulUpdate(t);
    return;
  }
  UpdateAnatomy anatomy = checkSupport(t, points);
  const InnovationEstimate estimate = estimateInnovation(t, anatomy);
  tellUsedTwice(estimate, anatomy);
  hint(anatomy.allow);
  for (const Allow allow :
       {Allow::robocentric, Allow::fej, Allow::iterated, Allow::absolute_sensor}) {
    if (allows(allow) && !anatomy.fit.whole) anatomy.support = declaredAway(allow);
  }
  note(Law::support, anatomy.support, s);
  note(Law::rank, checkRank(t, anatomy), s);
  judgeShrink(t, false, !anatomy.fit.whole);
  note(Law::range, checkRange(t, anatomy), s);
  noteInnovation(estimate, s);
  judgeSensorNoise(t, anatomy, estimate);
}

void Audit::State::judgeLawfulUpdate(const Transition& t) {
  const Snapshot& s = *t.after;
  UpdateAnatomy anatomy;
  anatomy.observed = t.observed;
  anatomy.deltas = lawful.deltas();
  anatomy.fit.whole = true;
  anatomy.support = Outcome::of(lawful.support().residual, lawful.support().tolerance);
  note(Law::support, anatomy.support, s);
  note(Law::rank, checkRank(t, anatomy), s);
  note(Law::shrink,
       allows(Allow::inflation) ? declaredAway(Allow::inflation)
                                : Outcome::of(0.0, shrinkTolerance(t)),
       s);
  note(Law::range, Outcome::of(lawful.range().residual, lawful.range().tolerance), s);
  noteInnovation(lawful.innovation(), s);
  judgeSensorNoise(t, anatomy, lawful.innovation());
}

void Audit::State::judgeSensorNoise(const Transition& t, const UpdateAnatomy& anatomy,
                                    const InnovationEstimate& estimate) {
  const Snapshot& s = *t.after;
  const bool given = !s.observations.empty() && !s.observations.front().R.isZero(0.0);
  if (header.R || given) {
    note(Law::sensor_noise, checkSensorNoise(t, anatomy, estimate, header), s);
  }
  note(Law::jacobian_given, checkJacobianGiven(t, points, header.sensor), s);
}

void Audit::State::judgeInitialisation(const Transition& t) {
  if (allows(Allow::diffuse_initialisation) || allows(Allow::robocentric)) {
    note(Law::initialise,
         declaredAway(allows(Allow::robocentric) ? Allow::robocentric
                                                 : Allow::diffuse_initialisation),
         *t.after);
    return;
  }
  const InitialiseCheck check = checkInitialise(t, header.sensor, header.R);
  hint(check.allow);
  note(Law::initialise, check.outcome, *t.after);
}

void Audit::State::judgeStep(const Transition& t) {
  const Snapshot& s = *t.after;
  judgeShrink(t, true, true);
  if (t.shared == 0) return;
  if (!s.extra.empty()) {
    note(Law::rank, Outcome::notCheckable(kExtraStates), s);
  } else if (allows(Allow::moving_features) || allows(Allow::robocentric)) {
    note(Law::rank,
         declaredAway(allows(Allow::robocentric) ? Allow::robocentric : Allow::moving_features), s);
  } else {
    UpdateAnatomy anatomy = checkStepRank(t);
    if (!anatomy.support.violated() || !initialisedAgain(t, anatomy.support)) {
      note(Law::rank, anatomy.support, s);
    }
  }
  noteInnovation(estimateStepInnovation(t), s);
}

}  // namespace slamscope::slam
