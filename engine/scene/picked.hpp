// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace slamscope::engine {

/// A pixel to pick at.
struct PickPlace {
  std::uint32_t view = 0;
  Eigen::Vector2i pixel = Eigen::Vector2i::Zero();
  int reach_px = 0;  ///< where nothing is there the nearest within so many rows and columns
};

/// What is seen at a pixel.
struct Picked {
  enum class Kind : std::uint32_t { line, arrow, cone, ellipsoid, pair };
  Kind kind = Kind::line;
  std::uint64_t tag = 0;                            ///< of the glyph; 0 for pairs
  std::uint32_t i = 0, j = 0;                       ///< of a pair the points, i < j
  Eigen::Vector2i pixel = Eigen::Vector2i::Zero();  ///< where it was found
};

}  // namespace slamscope::engine
