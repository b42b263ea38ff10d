// SPDX-License-Identifier: MIT
#include "slam/audit/law_tally.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slamscope::slam {

void LawTally::take(const Outcome& outcome, std::uint64_t record, double time_s) {
  if (outcome.kind == Outcome::Kind::not_applicable) return;
  if (outcome.kind == Outcome::Kind::not_checkable) {
    if (reason_.empty()) reason_ = outcome.reason;
    return;
  }
  ++checked_;
  if (!outcome.violated()) {
    if (outcome.residual >= whole_residual_) {
      whole_residual_ = outcome.residual;
      whole_tolerance_ = outcome.tolerance;
    }
    return;
  }
  if (violations_++ == 0) {
    first_record_ = record;
    first_time_s_ = time_s;
  }
  const double excess = std::isfinite(outcome.residual)
                            ? outcome.residual / std::max(outcome.tolerance, 1e-300)
                            : std::numeric_limits<double>::infinity();
  // Evidence that can be shown goes before a larger number that cannot.
  const bool better = outcome.evidence.empty() == worst_.evidence.empty()
                          ? excess > worst_excess_
                          : !outcome.evidence.empty();
  if (worst_excess_ < 0.0 || better) {
    worst_excess_ = excess;
    worst_ = outcome;
  }
  for (const Blame& b : outcome.blame) blame_[b.feature] += b.share;
  for (const std::string_view pattern : outcome.patterns) ++patterns_[pattern];
}

double LawTally::share(std::string_view pattern) const {
  const auto found = patterns_.find(pattern);
  if (found == patterns_.end() || violations_ == 0) return 0.0;
  return static_cast<double>(found->second) / static_cast<double>(violations_);
}

LawReport LawTally::report(Law law) const {
  LawReport report;
  report.law = law;
  report.checked = checked_;
  report.violations = violations_;
  report.reason = reason_;
  if (checked_ == 0) return report;
  report.status = violations_ > 0 ? LawStatus::violated : LawStatus::ok;
  report.worst = violations_ > 0 ? worst_.residual : whole_residual_;
  report.tolerance = violations_ > 0 ? worst_.tolerance : whole_tolerance_;
  if (violations_ == 0) return report;
  report.first_record = first_record_;
  report.first_time_s = first_time_s_;
  report.evidence = worst_.evidence;
  report.amount = worst_.amount;
  double total = 0.0;
  double most = 0.0;
  for (const auto& [id, weight] : blame_) {
    total += weight;
    most = std::max(most, weight);
  }
  for (const auto& [id, weight] : blame_) {
    if (weight >= 0.02 * most) report.blame.push_back({id, weight / total});
  }
  std::stable_sort(report.blame.begin(), report.blame.end(),
                   [](const Blame& a, const Blame& b) { return a.share > b.share; });
  return report;
}

}  // namespace slamscope::slam
