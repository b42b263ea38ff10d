// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace slamscope::apps {

/// The known word closest to a mistyped one by edit distance (insertions, deletions, replacements);
/// none where even the closest differs in more than a third of its letters (at least two).
[[nodiscard]] std::optional<std::string> nearestWord(std::string_view mistyped,
                                                     std::span<const std::string> known);

}  // namespace slamscope::apps
