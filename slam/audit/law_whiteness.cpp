// SPDX-License-Identifier: MIT
#include "slam/audit/law_whiteness.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace slamscope::slam {
namespace {

constexpr double kGranted = 0.15;

}  // namespace

void WhitenessLaw::take(const Snapshot& snapshot) {
  for (const ObservationRecord& o : snapshot.observations) {
    const Eigen::LLT<Eigen::Matrix2d> factor(o.S);
    if (factor.info() != Eigen::Success || !o.innovation.allFinite() || !o.S.allFinite()) continue;
    const Eigen::Vector2d w = factor.matrixL().solve(o.innovation);
    const auto found = last_.find(o.id);
    if (found != last_.end()) {
      const double c = w.dot(found->second);
      const double size = found->second.squaredNorm();
      ++count_;
      sum_ += c;
      squares_ += size;
      for (std::size_t k = 0; k < kWeights.size(); ++k) {
        const double weight = kWeights[k];
        const double quadratic = 0.5 * weight * weight * size;
        logs_[2 * k] += weight * (c - kGranted * size) - quadratic;
        logs_[2 * k + 1] += weight * (-c - kGranted * size) - quadratic;
      }
      const double top = *std::max_element(logs_.begin(), logs_.end());
      peak_ = std::max(peak_, top - std::log(static_cast<double>(logs_.size())));
      if (peak_ > std::log(1.0 / alpha_) && !first_record_) {
        first_record_ = snapshot.sequence;
        first_time_s_ = seconds(snapshot.time);
      }
    }
    last_[o.id] = w;
  }
}

Outcome WhitenessLaw::outcome() const {
  if (count_ == 0) return Outcome::notCheckable("no innovations in the log (level L3)");
  Outcome outcome = Outcome::of(peak_, std::log(1.0 / alpha_));
  if (!outcome.violated()) return outcome;
  const std::string what = "correlation of successive innovations";
  outcome.show(what, sum_ / squares_, 0.0);
  outcome.amount = "innovations that follow one another are correlated";
  return outcome;
}

}  // namespace slamscope::slam
