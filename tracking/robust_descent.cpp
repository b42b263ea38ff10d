// SPDX-License-Identifier: MIT
#include "tracking/robust_descent.hpp"

#include <cmath>

namespace slamscope::tracking {

RobustTerm robustTerm(double e2, double scale) {
  constexpr double kFullWeightSigmas = 4;
  const double limit = kFullWeightSigmas * scale, l2 = limit * limit;
  if (e2 <= l2) return {.weight = 1, .cost = e2};
  return {.weight = l2 / e2, .cost = l2 * (1 + std::log(e2 / l2))};
}

double errorScale(std::vector<double> errors) {
  constexpr double kQuantile = 0.35;
  static const double unit = std::sqrt(-2 * std::log(1 - kQuantile));
  const auto at =
      errors.begin() + static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(errors.size()));
  std::nth_element(errors.begin(), at, errors.end());
  return std::max(1.0, *at / unit);
}

}  // namespace slamscope::tracking
