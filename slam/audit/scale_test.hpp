// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace slamscope::slam {

/// Sequential two-sided test that values q_k are s·χ² with a scale s within [low, high] around 1,
/// each given its past: valid at all times at once, however often one looks.
///
/// For a fixed s₁ > high the product of likelihood ratios
///   Π (s₁/high)^(−r/2) exp(q/2 (1/high − 1/s₁))
/// is a supermartingale under every s ≤ high (Wald 1945; as an e-process Ramdas et al.,
/// "Game-theoretic statistics and safe anytime-valid inference", 2023), as is the mean of several
/// such products; so it exceeds 1/α at any time with probability α at most (Ville's inequality).
/// Likewise below. The band [low, high] is what the linearisation of an EKF is granted.
class ScaleTest {
 public:
  struct Band {
    double low = 0.6;
    double high = 1.5;
  };
  explicit ScaleTest(Band band) : band_(band) {}

  /// A squared normalised value with `dof` degrees of freedom. Non-finite ones count as huge.
  void take(double q, int dof);

  /// log e-value against too large and too small scales, the largest over time so far: compare with
  /// log(2/α).
  [[nodiscard]] double evidenceAbove() const { return peak_above_; }
  [[nodiscard]] double evidenceBelow() const { return peak_below_; }
  [[nodiscard]] double evidence() const;
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::uint64_t dof() const { return dof_; }
  /// Mean of q over degrees of freedom: the scale found.
  [[nodiscard]] double mean() const;

 private:
  static constexpr std::array kFactors{1.3, 1.8, 3.0, 6.0, 15.0, 60.0};

  Band band_;
  std::array<double, kFactors.size()> above_{};
  std::array<double, kFactors.size()> below_{};
  double peak_above_ = 0.0;
  double peak_below_ = 0.0;
  double sum_ = 0.0;
  std::uint64_t dof_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace slamscope::slam
