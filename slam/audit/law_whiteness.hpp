// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <optional>

#include "slam/audit/outcome.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// whiteness: innovations of a feature that follow one another are uncorrelated (level L3). With
/// w = S^(−1/2) ν, c_k = w_k · w_(k−1) given the past is N(0, ‖w_(k−1)‖²), so
/// exp(λ (c_k − m‖w‖²) − λ² ‖w‖²/2) multiplies to a supermartingale while the correlation is at
/// most m; mean over several λ of both signs, threshold by Ville's inequality as in scale_test.hpp.
/// m = 0.15 is granted to linearisation.
class WhitenessLaw {
 public:
  explicit WhitenessLaw(double alpha) : alpha_(alpha) {}

  void take(const Snapshot& snapshot);
  [[nodiscard]] Outcome outcome() const;
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] const std::optional<std::uint64_t>& firstRecord() const { return first_record_; }
  [[nodiscard]] double firstTime() const { return first_time_s_; }

 private:
  static constexpr std::array kWeights{0.03, 0.1, 0.3};

  double alpha_;
  std::map<FeatureId, Eigen::Vector2d> last_;
  std::array<double, 2 * kWeights.size()> logs_{};
  double peak_ = 0.0;
  double sum_ = 0.0;
  double squares_ = 0.0;
  std::uint64_t count_ = 0;
  std::optional<std::uint64_t> first_record_;
  double first_time_s_ = 0.0;
};

}  // namespace slamscope::slam
