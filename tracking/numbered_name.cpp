// SPDX-License-Identifier: MIT
#include "tracking/numbered_name.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace slamscope::tracking {

namespace {

constexpr std::string_view kFigures = "0123456789";

}  // namespace

std::string NumberedName::of(std::size_t number) const {
  const std::string figures = std::to_string(number);
  return before + std::string(digits - std::min(digits, figures.size()), '0') + figures + after;
}

bool NumberedName::fits(std::string_view name) const {
  const std::size_t around = before.size() + after.size();
  return name.size() >= around + digits && name.starts_with(before) && name.ends_with(after) &&
         name.substr(before.size(), name.size() - around).find_first_not_of(kFigures) ==
             std::string_view::npos;
}

std::optional<NumberedName> numberedName(std::string_view pattern) {
  constexpr std::size_t kMostDigits = 12;
  const std::size_t begin = pattern.find('%');
  if (begin == std::string_view::npos) return std::nullopt;
  const std::string_view field = pattern.substr(begin + 1);
  const std::size_t end = field.find_first_not_of(kFigures);
  if (end == std::string_view::npos || field[end] != 'd') return std::nullopt;
  NumberedName name;
  name.before = pattern.substr(0, begin);
  name.after = field.substr(end + 1);
  if (name.after.find('%') != std::string::npos) return std::nullopt;
  if (end > 0) {
    const auto read = std::from_chars(field.data(), field.data() + end, name.digits);
    if (read.ec != std::errc() || name.digits > kMostDigits) return std::nullopt;
  }
  name.digits = std::max<std::size_t>(name.digits, 1);
  return name;
}

}  // namespace slamscope::tracking
