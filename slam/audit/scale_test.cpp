// SPDX-License-Identifier: MIT
#include "slam/audit/scale_test.hpp"

#include <algorithm>
#include <cmath>

namespace slamscope::slam {
namespace {

template <std::size_t Count>
double logMeanExp(const std::array<double, Count>& logs) {
  const double top = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double value : logs) sum += std::exp(value - top);
  return top + std::log(sum / static_cast<double>(Count));
}

/// peak ← the larger of it and log of the mean, which is never more than the largest of them.
template <std::size_t Count>
void raisePeak(double& peak, const std::array<double, Count>& logs) {
  if (*std::max_element(logs.begin(), logs.end()) > peak) peak = std::max(peak, logMeanExp(logs));
}

template <std::size_t Count>
std::array<double, Count> logarithms(const std::array<double, Count>& factors) {
  std::array<double, Count> logs{};
  for (std::size_t k = 0; k < Count; ++k) logs[k] = std::log(factors[k]);
  return logs;
}

}  // namespace

void ScaleTest::take(double q, int dof) {
  if (dof <= 0) return;
  q = std::isfinite(q) ? std::max(q, 0.0) : 1e6;
  ++count_;
  dof_ += static_cast<std::uint64_t>(dof);
  sum_ += q;
  static const std::array<double, kFactors.size()> kLogs = logarithms(kFactors);
  for (std::size_t k = 0; k < kFactors.size(); ++k) {
    const double f = kFactors[k];
    above_[k] += -0.5 * dof * kLogs[k] + 0.5 * q / band_.high * (1.0 - 1.0 / f);
    below_[k] += 0.5 * dof * kLogs[k] + 0.5 * q / band_.low * (1.0 - f);
  }
  raisePeak(peak_above_, above_);
  raisePeak(peak_below_, below_);
}

double ScaleTest::evidence() const {
  return std::max(peak_above_, peak_below_);
}

double ScaleTest::mean() const {
  return dof_ == 0 ? 1.0 : sum_ / static_cast<double>(dof_);
}

}  // namespace slamscope::slam
