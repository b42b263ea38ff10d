// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>

namespace slamscope::slam {

/// Seeded random numbers whose sequence the standard fixes (std::normal_distribution's is left to
/// the library), so that a seed means the same run everywhere.
class RandomSource {
 public:
  explicit RandomSource(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1), 53 bits.
  double uniform();
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal, by Marsaglia's polar method.
  double normal();

 private:
  std::mt19937_64 engine_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace slamscope::slam
