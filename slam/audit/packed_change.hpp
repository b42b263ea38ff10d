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

/// Two vectors and their images under D.
struct TwoImages {
  const double* w = nullptr;
  const double* v = nullptr;
  double* of_w = nullptr;  ///< D w is added
  double* of_v = nullptr;  ///< D v is added
};

/// What rows `first` … `last` − 1 of the lower triangle, and what stands mirrored above it, add to
/// D w and D v. Each entry is fetched once for both triangles and both vectors.
void addImages(const PackedChange& D, std::ptrdiff_t first, std::ptrdiff_t last,
               const TwoImages& images);

}  // namespace slamscope::slam
