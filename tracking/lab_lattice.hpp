// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace slamscope::tracking::lab {

/// Place in the pixel and moment of the exposure, each 0..1.
struct LatticePoint {
  double x, y, moment;
};

/// A Korobov lattice: `size` different columns, rows and moments, evenly spread also together, so
/// that an edge of any direction is placed to 1 / (2 size) px or better. (A grid of 10 × 10
/// misplaces an edge along its own axes by up to 1/20 px.)
template <int size, int generator>
constexpr std::array<LatticePoint, size> makeLattice() {
  std::array<LatticePoint, size> points{};
  for (int i = 0; i < size; ++i)
    points[i] = {(i + 0.5) / size, (i * generator % size + 0.5) / size,
                 (i * generator * generator % size + 0.5) / size};
  return points;
}

inline constexpr auto kFine = makeLattice<97, 52>();   // what stands still
inline constexpr auto kQuick = makeLattice<31, 11>();  // what moves, and is blurred by it

}  // namespace slamscope::tracking::lab
