// SPDX-License-Identifier: MIT
#include "slam/audit/law_support.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "slam/audit/change_range.hpp"
#include "slam/audit/innovation_estimate.hpp"
#include "slam/audit/support_diagnosis.hpp"

namespace slamscope::slam {
namespace {

constexpr int kProbes = 2;
constexpr int kMostUnknownRank = 64;

/// O where the log does not say it: every i with P⁻B_iᵀ ∈ range(D).
std::vector<int> observedFromRange(const Transition& t, const ChangeRange& range) {
  std::vector<int> observed;
  for (int i = 0; i < t.shared; ++i) {
    const Eigen::Vector2d delta = lawfulDeltas(*t.before, {i})[0];
    if (contains(t, range, i, delta)) observed.push_back(i);
  }
  return observed;
}

Outcome outcomeOf(const Transition& t, const SpanFit& fit) {
  if (fit.whole) {
    if (!fit.checkable)
      return Outcome::notCheckable("the change of P drowns in the log's rounding");
    return Outcome::of(fit.residual, fit.tolerance);
  }
  // Whatever is unresolved in a rounded log may explain what is left over.
  if (t.rounded && !fit.checkable) {
    return Outcome::notCheckable("the change of P drowns in the log's rounding");
  }
  return Outcome::of(fit.residual, fit.tolerance);
}

/// The mean after the last prediction, where all of O was in the map then.
std::optional<std::vector<Eigen::Vector2d>> frozenDeltas(const Transition& t,
                                                         const LinearisationPoints& points,
                                                         const std::vector<int>& observed) {
  if (!points.after_prediction) return std::nullopt;
  std::vector<Eigen::Vector2d> deltas;
  for (const int i : observed) {
    const std::optional<Eigen::Vector2d> then = points.after_prediction->feature(t.id(i));
    if (!then) return std::nullopt;
    deltas.emplace_back(*then - points.after_prediction->pose.head<2>());
  }
  return deltas;
}

}  // namespace

UpdateAnatomy checkSupport(const Transition& t, const LinearisationPoints& points) {
  UpdateAnatomy anatomy;
  anatomy.observed = t.observed;
  if (!t.observed_given) {
    const ChangeRange range = rangeOfChange(t, 5, kMostUnknownRank);
    if (!range.complete) {
      anatomy.support = Outcome::notCheckable("the rank of P's change reaches the size of P");
      return anatomy;
    }
    anatomy.observed = observedFromRange(t, range);
    anatomy.observed_found = true;
  }
  if (2 * static_cast<int>(anatomy.observed.size()) >= t.size()) {
    anatomy.support = Outcome::notCheckable("the rank of P's change reaches the size of P");
    return anatomy;
  }
  anatomy.deltas = lawfulDeltas(*t.before, anatomy.observed);
  anatomy.change = probeChange(t, 0, kProbes);
  anatomy.basis = observationBasis(t, anatomy.observed, anatomy.deltas);
  anatomy.span = orthonormal(anatomy.basis);
  anatomy.fit = fitSpan(t, anatomy.change, anatomy.span);
  anatomy.support = outcomeOf(t, anatomy.fit);
  if (!anatomy.support.violated()) return anatomy;
  if (const auto frozen = frozenDeltas(t, points, anatomy.observed)) {
    SpanBasis basis = observationBasis(t, anatomy.observed, *frozen);
    OrthonormalSpan span = orthonormal(basis);
    SpanFit fit = fitSpan(t, anatomy.change, span);
    if (fit.whole) {
      anatomy.deltas = *frozen;
      anatomy.basis = std::move(basis);
      anatomy.span = std::move(span);
      anatomy.fit = std::move(fit);
      anatomy.support = outcomeOf(t, anatomy.fit);
      anatomy.allow = "frozen-linearisation";
      return anatomy;
    }
  }
  diagnoseSupport(t, points, anatomy);
  return anatomy;
}

void tellUsedTwice(const InnovationEstimate& estimate, UpdateAnatomy& anatomy) {
  constexpr double kMost = 0.4;  // a compass: 0 but for rounding; used twice: 0.7
  if (!anatomy.heading_besides || !(estimate.heading_correlation > kMost)) return;
  anatomy.allow.reset();
  anatomy.support = Outcome::of(estimate.heading_correlation, kMost);
  anatomy.support.patterns.emplace_back("observed-twice");
  anatomy.support.amount =
      "P changes as if an observation were used again at the mean that its first use left";
}

UpdateAnatomy checkStepRank(const Transition& t) {
  UpdateAnatomy anatomy;
  anatomy.observed = t.observed;
  if (!t.observed_given) {
    anatomy.support = Outcome::notCheckable("`observed` is not in the log");
    return anatomy;
  }
  if (2 * static_cast<int>(t.observed.size()) + 1 >= 2 * t.shared) {
    anatomy.support = Outcome::notCheckable("the rank of P's change reaches the size of P");
    return anatomy;
  }
  anatomy.change = probeChange(t, 3, kProbes);
  anatomy.basis = looseBasis(t, t.observed, 3);
  anatomy.fit = fitSpan(t, anatomy.change, anatomy.basis);
  anatomy.support = outcomeOf(t, anatomy.fit);
  if (!anatomy.support.violated()) return anatomy;
  anatomy.outside =
      culprits(t, anatomy.change, anatomy.basis, std::max(1, std::min(12, t.shared / 2)));
  for (const int i : anatomy.outside) {
    anatomy.support.blame.push_back({t.id(i), 1.0 / static_cast<double>(anatomy.outside.size())});
  }
  anatomy.support.amount = "P changes outside of what the observed features span";
  // Small and everywhere: another linearisation rule than that of an EKF.
  if (anatomy.outside.empty() && anatomy.support.residual < 0.05) {
    anatomy.support = Outcome::notCheckable("near the lawful span, not in it (UKF?)");
  }
  return anatomy;
}

Outcome checkRank(const Transition& t, const UpdateAnatomy& anatomy) {
  if (anatomy.support.kind != Outcome::Kind::checked) {
    return Outcome::notCheckable(anatomy.support.reason);
  }
  const int lawful = 2 * static_cast<int>(anatomy.observed.size());
  if (anatomy.fit.whole || lawful + 2 >= t.size()) return Outcome::of(lawful, lawful);
  const ChangeRange range = rangeOfChange(t, lawful, lawful + 5);
  Outcome outcome = Outcome::of(static_cast<double>(range.Q.cols()), lawful);
  if (!outcome.violated()) return outcome;
  outcome.blame = anatomy.support.blame;
  outcome.amount = "the change of P has rank " + std::to_string(range.Q.cols()) +
                   (range.complete ? "" : " or more") + ", lawful at most " +
                   std::to_string(lawful);
  return outcome;
}

}  // namespace slamscope::slam
