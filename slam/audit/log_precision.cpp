// SPDX-License-Identifier: MIT
#include "slam/audit/log_precision.hpp"

#include <algorithm>
#include <cmath>

namespace slamscope::slam {
namespace {

constexpr double kRoundoff = 2.3e-16;

/// Whether v is a whole multiple of 1 / scale but for the rounding of a double.
bool isMultiple(double value, double scale) {
  const double multiple = value * scale;
  return std::abs(multiple - std::round(multiple)) <= 4.0 * kRoundoff * std::abs(multiple);
}

}  // namespace

void LogPrecision::take(std::span<const double> numbers) {
  if (isDouble()) return;
  // A stride that is no multiple of small numbers meets all kinds of entries of a triangle.
  const std::size_t stride = numbers.size() <= 120 ? 1 : numbers.size() / 101 | 1U;
  for (std::size_t k = 0; k < numbers.size(); k += stride) takeOne(numbers[k]);
}

void LogPrecision::takeOne(double value) {
  if (value == 0.0 || !std::isfinite(value)) return;
  seen_ = true;
  float32_ = float32_ && static_cast<double>(static_cast<float>(value)) == value;
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  while (digits_ < kDouble && !isMultiple(value, std::pow(10.0, digits_ - 1 - exponent))) ++digits_;
  while (decimals_ < kManyDecimals && !isMultiple(value, std::pow(10.0, decimals_))) ++decimals_;
}

double LogPrecision::relative() const {
  // Nobody logs three digits: these are round numbers, as at the start, and exact.
  if (!seen_ || isDouble() || digits_ <= kRound) return 0.5 * kRoundoff;
  if (float32_ && digits_ > 7) return 6e-8;
  return std::max(0.5 * kRoundoff, 0.5 * std::pow(10.0, 1 - digits_));
}

double LogPrecision::absolute() const {
  if (!seen_ || isDouble() || digits_ <= kRound || (float32_ && digits_ > 7) ||
      decimals_ >= kManyDecimals)
    return 0.0;
  return 0.5 * std::pow(10.0, -decimals_);
}

std::string LogPrecision::name() const {
  if (!seen_ || digits_ <= kRound) return "unknown";
  if (isDouble()) return "double";
  if (float32_ && digits_ > 7) return "float32";
  if (absolute() > 0.0) return std::to_string(decimals_) + " decimals";
  return std::to_string(digits_) + " digits";
}

}  // namespace slamscope::slam
