// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>

#include "tracking/image_view.hpp"
#include "tracking/tag_cells.hpp"

namespace slamscope::tracking {

/// How a picture compares with the print of a tag.
struct PrintMatch {
  int wrong = 0;      ///< cells that are black where white is printed, or the other way round
  double margin = 0;  ///< half the difference of white and black cells, grey levels
  /// No wrong cell on either side of the square's edge: nothing covers the sides that corners are
  /// made from.
  bool whole_edge = true;
  bool in_picture = true;  ///< the whole print, its white border too; else nothing was compared
};

/// Looks at the middle of each cell between four corners (order of tagCorners, px) of a grey
/// picture.
[[nodiscard]] PrintMatch comparePrint(const ImageView& grey,
                                      const std::array<Eigen::Vector2d, 4>& corners_px,
                                      const TagCells& print);

}  // namespace slamscope::tracking
