// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/scene/glyphs.hpp"
#include "engine/scene/pair_glyphs.hpp"
#include "engine/scene/view.hpp"

// What drawing pairs is measured with: a floor of 3 m × 3 m seen from above, and maps on it.
namespace slamscope::engine {

inline constexpr Pinhole kBenchCamera = {
    .width = 1280, .height = 720, .fx = 900.0, .fy = 900.0, .cx = 639.5, .cy = 359.5};

/// One eye or two, 64 mm apart, 3 m before and 2.6 m above the middle of the floor.
[[nodiscard]] std::vector<View> aboveFloor(std::size_t count);

/// A map of n features all over the floor, in no order: all pairs of it. The more there are the
/// smaller they are: the 3-sigma semi-axes of pairs are some 16 px long for 15 features and 2 px
/// for 1000.
[[nodiscard]] PairGlyphs mapOf(int n, unsigned seed);

}  // namespace slamscope::engine
