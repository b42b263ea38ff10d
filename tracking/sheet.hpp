// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace slamscope::tracking {

enum class SheetKind {
  tags,        ///< single tags to hang up, each with its id and size
  april_grid,  ///< a board of tags at equal distances
  chessboard
};

struct SheetOptions {
  SheetKind kind = SheetKind::tags;
  double paper_width_mm = 210, paper_height_mm = 297;  ///< A4
  std::string family = "36h11";                        ///< of tags and grids
  int first_id = 0, count = 6;                         ///< of tags; a grid has columns × rows
  double size_mm = 80;        ///< side of the black square, or of a chessboard's square
  int columns = 6, rows = 8;  ///< of tags, or of the chessboard's inner corners
  double spacing = 0.3;       ///< of a grid: gap between tags, parts of their size
};

/// A PDF, true to scale, of as many pages as it takes, each with a bar of 100 mm to check the
/// printer by. Throws std::invalid_argument, one line: a board or tag that doesn't fit the paper,
/// ids that the family doesn't have.
[[nodiscard]] std::string sheetPdf(const SheetOptions& options);
/// Writes it. Throws std::runtime_error where the file can't be written.
void writeSheet(const SheetOptions& options, const std::filesystem::path& file);

}  // namespace slamscope::tracking
