// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace slamscope::apps {

/// What a glyph of the scene stands for; travels with it as its tag. Indices < 2²⁸.
struct GlyphMeaning {
  enum class What : std::uint8_t {
    unsaid,
    robot,
    path,
    feature,  ///< i, in the snapshot's order
    pair,     ///< features i and j
    halo,     ///< of that pair
    mean,     ///< of the pairs between clusters i and j
  };
  What what = What::unsaid;
  std::uint32_t i = 0, j = 0;

  [[nodiscard]] constexpr std::uint64_t tag() const {
    return std::uint64_t{static_cast<std::uint8_t>(what)} << 56U | std::uint64_t{i} << 28U | j;
  }
  [[nodiscard]] static constexpr GlyphMeaning ofTag(std::uint64_t tag) {
    constexpr std::uint32_t kIndex = (1U << 28U) - 1U;
    return {.what = static_cast<What>(tag >> 56U),
            .i = static_cast<std::uint32_t>(tag >> 28U) & kIndex,
            .j = static_cast<std::uint32_t>(tag) & kIndex};
  }
};

}  // namespace slamscope::apps
