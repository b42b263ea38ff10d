// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace slamscope::tracking {

/// Names of a row of pictures, as `frame-%05d.png` states them.
struct NumberedName {
  std::string before, after;
  std::size_t digits = 1;  ///< at least; shorter numbers begin with zeros

  [[nodiscard]] std::string of(std::size_t number) const;
  /// Whether a name is one of them, of whatever number.
  [[nodiscard]] bool fits(std::string_view name) const;
};

/// From a name or path with one %d or %0Nd (N to 12) and no other %, else nothing.
[[nodiscard]] std::optional<NumberedName> numberedName(std::string_view pattern);

}  // namespace slamscope::tracking
