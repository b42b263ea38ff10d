// SPDX-License-Identifier: MIT
#include "slam/audit/law_nis.hpp"

#include <algorithm>
#include <cmath>

namespace slamscope::slam {

double NisLaw::featureThreshold() const {
  // A quarter of α/2 on each of the first features, less on later ones, would need an order; equal
  // shares of those seen so far, rounded up to a power of two, change rarely and stay valid by the
  // union over the sizes (share 2^-k of the budget for the k-th doubling, at least 1/8).
  double size = 16.0;
  double budget = 0.5;
  while (size < static_cast<double>(by_feature_.size())) {
    size *= 4.0;
    budget *= 0.5;
  }
  return std::log(4.0 * size / (alpha_ * budget));
}

void NisLaw::take(const InnovationEstimate& estimate, const Sample& sample) {
  if (estimate.dof == 0) return;
  overall_.take(estimate.nis, estimate.dof);
  bool broken = overall_.evidence() > std::log(4.0 / alpha_);
  double evidence = 0.0;
  for (const FeatureInnovation& f : estimate.features) {
    if (f.dof == 0) continue;
    const auto entry = by_feature_.try_emplace(f.id, ScaleTest({0.6, 1.5})).first;
    entry->second.take(f.nis, f.dof);
    evidence = std::max(evidence, entry->second.evidence());
  }
  broken = broken || evidence > featureThreshold();
  if (broken && !first_) first_ = FirstBroken{sample.record, sample.time_s};
}

std::vector<Blame> NisLaw::blame() const {
  std::vector<Blame> result;
  double most = 0.0;
  for (const auto& [id, test] : by_feature_) {
    if (test.evidence() > featureThreshold()) most = std::max(most, test.evidence());
  }
  double total = 0.0;
  for (const auto& [id, test] : by_feature_) {
    if (test.evidence() <= featureThreshold() || test.evidence() < 0.3 * most) continue;
    result.push_back({id, test.evidence()});
    total += test.evidence();
  }
  for (Blame& b : result) b.share /= total;
  // Where most of the map stands out, no feature is to blame.
  if (2 * result.size() > by_feature_.size()) result.clear();
  return result;
}

Outcome NisLaw::outcome() const {
  if (overall_.count() < 1) return Outcome::notCheckable("no update could be measured");
  Outcome outcome = Outcome::of(overall_.evidence(), std::log(4.0 / alpha_));
  double worst = 0.0;
  for (const auto& [id, test] : by_feature_) worst = std::max(worst, test.evidence());
  const double threshold = featureThreshold();
  if (!outcome.violated() && worst > threshold) outcome = Outcome::of(worst, threshold);
  if (!outcome.violated()) return outcome;
  outcome.blame = blame();
  outcome.show("mean NIS per degree of freedom", overall_.mean(), 1.0);
  const bool above = std::max(overall_.evidenceAbove(), worst) >= overall_.evidenceBelow();
  outcome.amount = above ? "innovations are larger than the filter believes"
                         : "innovations are smaller than the filter believes";
  outcome.patterns.emplace_back(above ? "nis-high" : "nis-low");
  if (above && outcome.blame.size() == 1) outcome.patterns.emplace_back("nis-one-feature");
  return outcome;
}

}  // namespace slamscope::slam
