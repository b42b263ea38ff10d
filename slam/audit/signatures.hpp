// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slam/audit/law_tally.hpp"

namespace slamscope::slam {

using LawTallies = std::array<LawTally, kLawCount>;

/// A programming mistake and how it shows: a way in which a law is broken (Outcome::patterns;
/// empty: any) in at least `share` of its violations, while the laws of `whole` are not broken.
struct Signature {
  std::string_view name;  ///< as in the fault catalogue, where it is there
  Law law;
  std::string_view pattern;
  double share;
  std::vector<Law> whole;
  std::string_view likely;
};

/// The table, the most telling first.
[[nodiscard]] std::span<const Signature> signatures();

/// The mistakes that fit, the most telling first. At most one for each law.
[[nodiscard]] std::vector<const Signature*> fitting(const LawTallies& tallies);

}  // namespace slamscope::slam
