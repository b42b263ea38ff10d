// SPDX-License-Identifier: MIT
#include "slam/audit/audit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

#include "slam/audit/audit_state.hpp"
#include "slam/audit/innovation_estimate.hpp"
#include "slam/audit/law_finite.hpp"
#include "slam/audit/law_symmetric.hpp"
#include "slam/correlation.hpp"

namespace slamscope::slam {
namespace {

constexpr std::array<std::string_view, 8> kAllowNames{"moving-features",
                                                      "absolute-sensor",
                                                      "inflation",
                                                      "robocentric",
                                                      "fej",
                                                      "frozen-linearisation",
                                                      "iterated",
                                                      "diffuse-initialisation"};

bool sameSize(const Snapshot& a, const Snapshot& b) {
  return a.ids == b.ids && a.covariance.size() == b.covariance.size();
}

}  // namespace

std::string_view allowName(Allow allow) {
  return kAllowNames.at(static_cast<std::size_t>(allow));
}

Allow allowFromName(std::string_view name) {
  const auto found = std::find(kAllowNames.begin(), kAllowNames.end(), name);
  if (found != kAllowNames.end()) return static_cast<Allow>(found - kAllowNames.begin());
  std::string known;
  for (const std::string_view word : kAllowNames) {
    known += (known.empty() ? "" : ", ") + std::string(word);
  }
  throw std::invalid_argument("nothing of the name '" + std::string(name) +
                              "' can be allowed; known: " + known);
}

Outcome declaredAway(Allow allow) {
  return Outcome::notCheckable("not looked at: --allow " + std::string(allowName(allow)));
}

Audit::State::State(AuditOptions options_in, RunHeader header_in)
    : options(std::move(options_in)),
      header(std::move(header_in)),
      nis(options.alpha / 4.0),
      nis_given(options.alpha / 4.0),
      whiteness(options.alpha / 4.0) {
  if (!(options.alpha > 0.0 && options.alpha < 1.0)) {
    throw std::invalid_argument("audit: alpha " + std::to_string(options.alpha) +
                                " is not in (0, 1)");
  }
}

bool Audit::State::repeatsLast(const Snapshot& s) const {
  if (!every_event || s.event != Event::step || !last || s.time != last->time) return false;
  if (!sameSize(s, *last) || s.pose != last->pose || s.features != last->features) return false;
  const std::span<const double> a = s.covariance.packed();
  return std::memcmp(a.data(), last->covariance.packed().data(), a.size_bytes()) == 0;
}

Exactness Audit::State::exactness() const {
  Exactness e;
  e.covariance = std::max(arithmetic, 2.0 * covariance_precision.relative());
  e.covariance_absolute = covariance_precision.absolute();
  e.mean = 2.0 * mean_precision.relative();
  e.mean_absolute = mean_precision.absolute();
  e.rounded = covariance_precision.isRounded();
  return e;
}

double Audit::State::recordNoise(const Snapshot& s) const {
  const double noise = exactness().covariance;
  if (!(covariance_precision.absolute() > 0.0)) return noise;
  double least = 1e300;
  for (int i = 0; i < s.covariance.size(); ++i) {
    if (s.covariance(i, i) > 0.0) least = std::min(least, s.covariance(i, i));
  }
  return noise + covariance_precision.absolute() / least;
}

void Audit::State::hint(const std::optional<std::string_view>& allow) {
  if (allow) ++allow_hints[*allow];
}

void Audit::State::note(Law law, const Outcome& outcome, const Snapshot& snapshot) {
  tallies[static_cast<std::size_t>(law)].take(outcome, snapshot.sequence, seconds(snapshot.time));
  checked = checked || outcome.checked();
  if (!outcome.violated()) return;
  newest.broken.push_back(law);
  for (const Blame& b : outcome.blame) {
    if (!std::binary_search(newest.features.begin(), newest.features.end(), b.feature)) {
      newest.features.insert(
          std::lower_bound(newest.features.begin(), newest.features.end(), b.feature), b.feature);
    }
    const auto [entry, fresh] = blamed.try_emplace(b.feature);
    if (fresh) {
      entry->second.alarm = {b.feature, law, snapshot.sequence, true, std::nullopt};
      if (last && last->indexOf(b.feature)) entry->second.last_good = last;
    }
    entry->second.last_update = updates;
  }
}

void Audit::State::noteInnovation(const InnovationEstimate& estimate, const Snapshot& snapshot) {
  const bool stood_out = nis.firstBroken().has_value();
  nis.take(estimate, {snapshot.sequence, seconds(snapshot.time)});
  checked = checked || estimate.dof > 0;
  newest.nis = estimate.nis;
  newest.dof = estimate.dof;
  if (nis.firstBroken() && !stood_out) newest.broken.push_back(Law::nis);
}

void Audit::State::count(const Snapshot& s) {
  if (records++ == 0) first_time_s = seconds(s.time);
  last_time_s = seconds(s.time);
  diagonal_only = diagonal_only || s.diagonal_only;
  observed_given = observed_given || s.observed_given;
  extra = extra || !s.extra.empty();
  truth = truth || s.truth.has_value();
  innovations = innovations || !s.observations.empty();
  // Not initialisations: they observe, but a feature that is written wrongly stands still in them.
  const bool observing_step = s.event == Event::step && !s.observed.empty();
  if (observing_step || s.event == Event::update) ++updates;
  covariance_precision.take(s.covariance.packed());
  if (!options.means_known) return;
  mean_precision.take({s.pose.data(), 3});
  if (!s.features.empty()) mean_precision.take({s.features.front().data(), 2 * s.features.size()});
}

void Audit::State::take(const SnapshotPtr& snapshot) {
  const Snapshot& s = *snapshot;
  if (s.event == Event::predict || s.event == Event::update || s.event == Event::initialise) {
    every_event = true;
  }
  if (repeatsLast(s)) return;
  count(s);
  newest = {};
  newest.judged = records;
  const std::optional<Transition> transition = lookAt(snapshot);
  last_finite = judgeRecord(s);
  if (transition && last_finite) judgeTransition(*transition);
  if (options.means_known) points.take(last, s);
  last = snapshot;
}

std::optional<Transition> Audit::State::lookAt(const SnapshotPtr& snapshot) {
  const Snapshot& s = *snapshot;
  swept = false;
  lawful.skip();
  if (!last || !last_finite || s.event == Event::initial || s.event == Event::remove) return {};
  Transition t = lineUp(last, snapshot, exactness());
  swept = s.event == Event::update && t.shared == s.featureCount() && s.extra.empty() &&
          comparable() && !t.rounded;
  if (swept) {
    sweep.take(t);
    lawful.take(t, sweep);
  }
  return t;
}

bool Audit::State::judgeRecord(const Snapshot& s) {
  const Outcome finite = checkFinite(s, options.means_known, swept && sweep.finite());
  note(Law::finite, finite, s);
  if (finite.violated()) return false;
  note(Law::symmetric, checkSymmetric(s, covariance_precision), s);
  const double noise = recordNoise(s);
  judgePositive(s, noise);
  if (allows(Allow::absolute_sensor)) {
    note(Law::heading_floor, declaredAway(Allow::absolute_sensor), s);
  } else if (allows(Allow::robocentric)) {
    note(Law::heading_floor, declaredAway(Allow::robocentric), s);
  } else {
    note(Law::heading_floor, heading_floor.check(s, noise), s);
  }
  if (!s.observations.empty()) judgeInnovationsGiven(s);
  return true;
}

void Audit::State::judgePositive(const Snapshot& s, double noise) {
  if (lawful.recognised()) {
    note(Law::positive, positive.confirm(s, noise), s);
    return;
  }
  std::vector<int> observed;
  for (const FeatureId id : s.observed) {
    if (const auto index = s.indexOf(id)) observed.push_back(*index);
  }
  const auto looking =
      s.event == Event::predict ? PositiveLaw::Looking::seldom : PositiveLaw::Looking::often;
  note(Law::positive, positive.check(s, observed, noise, looking), s);
}

void Audit::State::judgeInnovationsGiven(const Snapshot& s) {
  whiteness.take(s);
  InnovationEstimate given;
  for (const ObservationRecord& o : s.observations) {
    const double q = o.innovation.dot(o.S.inverse() * o.innovation);
    given.nis += q;
    given.dof += 2;
    given.features.push_back({o.id, q, 2});
  }
  if (!s.observations.front().S.isZero(0.0)) nis_given.take(given, {s.sequence, seconds(s.time)});
}

Audit::Audit(AuditOptions options, RunHeader header)
    : state_(std::make_unique<State>(std::move(options), std::move(header))) {}
Audit::~Audit() = default;
Audit::Audit(Audit&&) noexcept = default;
Audit& Audit::operator=(Audit&&) noexcept = default;

void Audit::take(const SnapshotPtr& snapshot) {
  state_->take(snapshot);
}

Subscription Audit::listen(Subject& subject) {
  return subject.observe([state = state_.get()](const SnapshotPtr& s) { state->take(s); });
}

AuditReport Audit::report() const {
  return state_->report();
}

const RecordFindings& Audit::lastRecord() const {
  return state_->newest;
}

Alarms Audit::alarms() const {
  Alarms alarms;
  const State& s = *state_;
  for (int k = 0; k < kLawCount; ++k) {
    if (s.tallies[static_cast<std::size_t>(k)].violations() > 0) {
      alarms.broken.push_back(static_cast<Law>(k));
    }
  }
  if (s.nis.firstBroken()) alarms.broken.push_back(Law::nis);
  const auto place = [](const Snapshot& snapshot, FeatureId id) { return snapshot.indexOf(id); };
  for (const auto& [id, blamed] : s.blamed) {
    FeatureAlarm alarm = blamed.alarm;
    alarm.active = s.isActive(blamed);
    const SnapshotPtr& good = blamed.last_good;
    const bool known = good && !good->diagonal_only;
    if (known) {
      const int row = Snapshot::row(*place(*good, id));
      alarm.last_good = good->covariance.block2(row, row);
    }
    if (alarm.active && s.last) {
      for (const FeatureId other : s.last->ids) {
        const auto partner = s.blamed.find(other);  // its pair with this one is listed already
        if (other == id ||
            (partner != s.blamed.end() && other < id && s.isActive(partner->second))) {
          continue;
        }
        PairAlarm pair{std::min(id, other), std::max(id, other), std::nullopt};
        const std::optional<int> i = known ? place(*good, id) : std::nullopt;
        const std::optional<int> j = known ? place(*good, other) : std::nullopt;
        if (i && j) pair.last_good = relativeCovariance(*good, *i, *j);
        alarms.pairs.push_back(pair);
      }
    }
    alarms.features.push_back(alarm);
  }
  return alarms;
}

}  // namespace slamscope::slam
