// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace slamscope::slam {

/// D = before − after of two symmetric matrices, both packed by rows of the lower triangle, seen
/// from state `begin` on: its first row and column is state `begin`'s.
struct PackedChange {
  const double* before = nullptr;
  const double* after = nullptr;
  std::ptrdiff_t begin = 0;

  /// Row `i` of the lower triangle of each, from state `begin` on: i + 1 numbers.
  [[nodiscard]] const double* rowBefore(std::ptrdiff_t i) const { return before + place(i); }
  [[nodiscard]] const double* rowAfter(std::ptrdiff_t i) const { return after + place(i); }

 private:
  [[nodiscard]] std::ptrdiff_t place(std::ptrdiff_t i) const {
    const std::ptrdiff_t row = begin + i;
    return row * (row + 1) / 2 + begin;
  }
};

/// What rows `first` … `last` − 1 of the lower triangle, and what stands mirrored above it, add to
/// the image D w. Each entry is fetched once for both triangles.
void addImage(const PackedChange& D, std::ptrdiff_t first, std::ptrdiff_t last, const double* w,
              double* image);

}  // namespace slamscope::slam
