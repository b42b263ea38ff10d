// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace slamscope::slam {

/// Seconds written as a decimal number ("1248444175.103", "-2e-3") in nanoseconds, rounded to the
/// nearest; digits are taken as written, so that a time of 2009 loses nothing to `double`. Nothing
/// where the text is not a number, not finite, or beyond ±292 years.
[[nodiscard]] std::optional<std::chrono::nanoseconds> parseSeconds(std::string_view text);

/// The same back, exactly and without zeros at the end: "1248444175.103", "-0.002", "2".
[[nodiscard]] std::string secondsText(std::chrono::nanoseconds time);

}  // namespace slamscope::slam
