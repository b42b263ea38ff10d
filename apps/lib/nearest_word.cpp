// SPDX-License-Identifier: MIT
#include "apps/lib/nearest_word.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace slamscope::apps {
namespace {

std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace

std::optional<std::string> nearestWord(std::string_view mistyped,
                                       std::span<const std::string> known) {
  const auto distance = [mistyped](const std::string& word) {
    return editDistance(mistyped, word);
  };
  const auto best = std::min_element(
      known.begin(), known.end(),
      [&](const std::string& a, const std::string& b) { return distance(a) < distance(b); });
  if (best == known.end()) return std::nullopt;
  const std::size_t allowed = std::max<std::size_t>(2, best->size() / 3);
  return distance(*best) <= allowed ? std::optional(*best) : std::nullopt;
}

}  // namespace slamscope::apps
