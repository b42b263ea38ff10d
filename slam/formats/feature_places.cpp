// SPDX-License-Identifier: MIT
#include "slam/formats/feature_places.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace slamscope::slam {
namespace {

/// Whether numbers seen one after the other are all NaN, or all zero.
struct Blank {
  bool nan = true, zero = true;
  /// False as soon as it is neither.
  bool take(double value) {
    nan = nan && std::isnan(value);
    zero = zero && value == 0.0;
    return nan || zero;
  }
};

bool meanIsBlank(std::span<const double> x, std::size_t row) {
  Blank mean;
  return x.empty() || (mean.take(x[row]) && mean.take(x[row + 1]));
}

bool covarianceIsBlank(std::span<const double> P, std::size_t size, std::size_t row) {
  Blank blank;
  if (P.size() == size) return blank.take(P[row]) && blank.take(P[row + 1]);
  for (std::size_t r = row; r < row + 2; ++r) {
    for (std::size_t k = 0; k < size; ++k) {
      if (!blank.take(P[r * size + k]) || !blank.take(P[k * size + r])) return false;
    }
  }
  return true;
}

bool poseIsSound(std::span<const double> x, std::span<const double> P, std::size_t size) {
  const bool diagonal = P.size() == size;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!x.empty() && !std::isfinite(x[k])) return false;
    if (!std::isfinite(P[diagonal ? k : k * size + k])) return false;
  }
  return true;
}

[[noreturn]] void failGone(int place) {
  throw std::runtime_error("ids: the feature in place " + std::to_string(place + 1) +
                           " is there no more, and without ids nobody can tell which one left: "
                           "save ids too, a row a step, padded with NaN");
}

}  // namespace

bool isPadding(std::span<const double> x, std::span<const double> P, std::size_t size, int place) {
  const std::size_t row = 3 + 2 * static_cast<std::size_t>(place);
  // Across P's blocks with the rows of other padding: NaN and zero do not mix in one array.
  return meanIsBlank(x, row) && covarianceIsBlank(P, size, row);
}

std::vector<int> FeaturePlaces::find(std::span<const double> x, std::span<const double> P,
                                     std::size_t size) {
  const std::size_t places = (size - 3) / 2;
  if (seen_.size() > places) failGone(static_cast<int>(places));
  seen_.resize(places);
  std::vector<int> found;
  for (int place = 0; place < static_cast<int>(places); ++place) {
    const auto k = static_cast<std::size_t>(place);
    if (isPadding(x, P, size, place)) {
      if (!seen_[k]) continue;
      if (poseIsSound(x, P, size)) failGone(place);
    }
    seen_[k] = true;
    found.push_back(place);
  }
  return found;
}

}  // namespace slamscope::slam
