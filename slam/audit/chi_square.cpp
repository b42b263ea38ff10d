// SPDX-License-Identifier: MIT
#include "slam/audit/chi_square.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slamscope::slam {
namespace {

constexpr int kTerms = 10000;

/// P(a, x) for x < a + 1.
double series(double a, double x, double front) {
  double term = 1.0 / a;
  double sum = term;
  for (int n = 1; n < kTerms && term > 1e-17 * sum; ++n) {
    term *= x / (a + n);
    sum += term;
  }
  return front * sum;
}

/// Q(a, x) = 1 − P(a, x) for x ≥ a + 1 (Lentz).
double fraction(double a, double x, double front) {
  const double tiny = std::numeric_limits<double>::min();
  double b = x + 1.0 - a;
  double c = 1.0 / tiny;
  double d = 1.0 / b;
  double h = d;
  for (int n = 1; n < kTerms; ++n) {
    const double an = -n * (n - a);
    b += 2.0;
    d = an * d + b;
    if (std::abs(d) < tiny) d = tiny;
    c = b + an / c;
    if (std::abs(c) < tiny) c = tiny;
    d = 1.0 / d;
    const double factor = d * c;
    h *= factor;
    if (std::abs(factor - 1.0) < 1e-15) break;
  }
  return front * h;
}

double upperTail(double value, double dof) {
  const double a = 0.5 * dof;
  const double x = 0.5 * value;
  if (!(x > 0.0)) return 1.0;
  const double front = std::exp(-x + a * std::log(x) - std::lgamma(a));
  return x < a + 1.0 ? 1.0 - series(a, x, front) : fraction(a, x, front);
}

}  // namespace

double chiSquareProbability(double value, double dof) {
  return 1.0 - upperTail(value, dof);
}

double chiSquareQuantile(double upper_tail, double dof) {
  double low = 0.0;
  double high = dof + 10.0;
  while (upperTail(high, dof) > upper_tail) high *= 2.0;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    (upperTail(middle, dof) > upper_tail ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace slamscope::slam
