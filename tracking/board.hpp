// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "tracking/image_view.hpp"

namespace slamscope::tracking {

/// A flat thing of known points to calibrate cameras with (see sheet.hpp). Board frame: first point
/// at the origin, x along a row, y from row to row, z = 0.
struct Board {
  enum class Kind { chessboard, april_grid };
  Kind kind = Kind::chessboard;
  int columns = 6, rows = 8;  ///< chessboard: inner corners; grid: tags
  double size_m = 0.025;      ///< chessboard: side of a square; grid: of a tag's black square
  double spacing = 0.3;       ///< grid: gap between tags, parts of their size
  int first_id = 0;           ///< grid: of the tag in the upper left
  std::string family = "36h11";
};

/// Points of the board in one picture.
struct BoardSight {
  std::vector<Eigen::Vector3d> p_board;  ///< m
  std::vector<Eigen::Vector2d> px;       ///< OpenCV's convention
};

/// Nothing where the board isn't (wholly, a chessboard; with at least four tags, a grid) in the
/// picture. A chessboard with the same number of squares' parity both ways may come turned by half
/// a turn. Throws std::invalid_argument for a chessboard below 3 × 3 inner corners.
[[nodiscard]] std::optional<BoardSight> findBoard(const ImageView& picture, const Board& board);

}  // namespace slamscope::tracking
