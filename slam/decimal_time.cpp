// SPDX-License-Identifier: MIT
#include "slam/decimal_time.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

namespace slamscope::slam {
namespace {

constexpr double kLongestSeconds = 9.2e9;

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

/// Plain digits with at most one point and up to ten of them before it; nothing for other forms.
std::optional<std::int64_t> plainDecimal(std::string_view digits) {
  std::int64_t ns = 0;
  std::size_t k = 0;
  while (k < digits.size() && isDigit(digits[k])) ns = ns * 10 + (digits[k++] - '0');
  if (k == 0 || k > 10 || ns > static_cast<std::int64_t>(kLongestSeconds)) return std::nullopt;
  if (k < digits.size() && digits[k] == '.') ++k;
  int places = 0;
  for (; places < 9; ++places) {
    const bool more = k < digits.size() && isDigit(digits[k]);
    ns = ns * 10 + (more ? digits[k++] - '0' : 0);
  }
  if (k < digits.size() && isDigit(digits[k]) && digits[k] >= '5') ++ns;
  while (k < digits.size() && isDigit(digits[k])) ++k;
  if (k != digits.size()) return std::nullopt;
  return ns;
}

}  // namespace

std::optional<std::chrono::nanoseconds> parseSeconds(std::string_view text) {
  const bool negative = text.starts_with('-');
  const std::string_view digits = negative || text.starts_with('+') ? text.substr(1) : text;
  if (const auto ns = plainDecimal(digits)) {
    return std::chrono::nanoseconds(negative ? -*ns : *ns);
  }
  if (digits.starts_with('-')) return std::nullopt;
  double seconds = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), seconds);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  if (!(seconds <= kLongestSeconds)) return std::nullopt;
  const auto ns =
      static_cast<std::int64_t>(std::llroundl(static_cast<long double>(seconds) * 1e9L));
  return std::chrono::nanoseconds(negative ? -ns : ns);
}

std::string secondsText(std::chrono::nanoseconds time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  const std::int64_t ns = time.count();
  std::string text = ns < 0 ? "-" : "";
  text += std::to_string(std::abs(ns / kSecond));
  if (const std::int64_t rest = std::abs(ns % kSecond); rest != 0) {
    const std::string digits = std::to_string(kSecond + rest);  // a 1 before the nine places
    text += '.' + digits.substr(1, digits.find_last_not_of('0'));
  }
  return text;
}

}  // namespace slamscope::slam
