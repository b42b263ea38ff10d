// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace slamscope::tracking {

/// The print of a tag: size × size cells, rows from the top, with the white border.
struct TagCells {
  int size = 10;         ///< cells across, all in all
  int across_black = 8;  ///< cells across the square whose corners are found (its stated size)
  int border = 1;        ///< cells from the edge to that square
  std::vector<bool> is_black;

  [[nodiscard]] bool black(int column, int row) const {
    return is_black[static_cast<std::size_t>(row) * static_cast<std::size_t>(size) +
                    static_cast<std::size_t>(column)];
  }
};

/// Throws std::invalid_argument for a family other than 36h11, 25h9, Standard41h12, or an id that
/// it doesn't have.
[[nodiscard]] TagCells tagCells(const std::string& family, int id);

}  // namespace slamscope::tracking
