// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "slam/audit/innovation_estimate.hpp"
#include "slam/audit/outcome.hpp"
#include "slam/audit/scale_test.hpp"

namespace slamscope::slam {

/// nis: the normalised innovation squared, recovered from x and P alone (innovation_estimate.hpp),
/// is χ². Two-sided, overall and per feature, by tests that hold at all times (scale_test.hpp);
/// half of `alpha` overall, half shared by the features. Statistics: noise mis-tuned, wrong
/// association, a moved feature, or the innovation's code. Also used for `nis-given`.
///
/// Band of the scale: overall 0.85 … 1.15, per feature 0.6 … 1.5. Means over runs of a correct
/// filter were seen between 0.97 and 1.03, also from a start heading of σ = 0.2 rad.
class NisLaw {
 public:
  explicit NisLaw(double alpha) : alpha_(alpha) {}

  struct Sample {
    std::uint64_t record = 0;
    double time_s = 0.0;
  };
  void take(const InnovationEstimate& estimate, const Sample& sample);

  struct FirstBroken {
    std::uint64_t record = 0;
    double time_s = 0.0;
  };
  [[nodiscard]] const std::optional<FirstBroken>& firstBroken() const { return first_; }
  [[nodiscard]] std::uint64_t count() const { return overall_.count(); }
  /// Residual: log e-value; tolerance: log(2/α) of the test that stands out most.
  [[nodiscard]] Outcome outcome() const;

 private:
  [[nodiscard]] double featureThreshold() const;
  [[nodiscard]] std::vector<Blame> blame() const;

  double alpha_;
  ScaleTest overall_{{0.85, 1.15}};
  std::map<FeatureId, ScaleTest> by_feature_;
  std::optional<FirstBroken> first_;
};

}  // namespace slamscope::slam
