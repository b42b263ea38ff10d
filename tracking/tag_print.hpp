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
};

/// Looks at the middle of each cell between four corners (order of tagCorners, px) of a grey
/// picture. Cells out of the picture are wrong.
[[nodiscard]] PrintMatch comparePrint(const ImageView& grey,
                                      const std::array<Eigen::Vector2d, 4>& corners_px,
                                      const TagCells& print);

}  // namespace slamscope::tracking
