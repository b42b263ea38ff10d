// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace slamscope::engine {

/// Axis-aligned rectangle of the picture, px, right and down.
struct PixelBox {
  Eigen::Vector2d min_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d max_px = Eigen::Vector2d::Zero();
};

/// A label that wants a place near its anchor.
struct LabelRequest {
  Eigen::Vector2d anchor_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d size_px = Eigen::Vector2d::Zero();  ///< of the text's box (measureText)
  /// Offset of the last frame: tried first, so that labels don't hop about.
  std::optional<Eigen::Vector2d> last_offset_px;
};

struct PlacementOptions {
  double gap_px = 6.0;    ///< from the anchor to the nearest edge of the text
  int rings = 3;          ///< distances tried: gap, gap + height, gap + 2 height …
  PixelBox picture = {};  ///< labels stay inside; empty: no bound
};

/// Offsets from anchor to text centre such that no label covers another nor an obstacle; greedy, in
/// the order given (first come, first served): below, above, right, left, then the diagonals, then
/// the same further out. None where every place is taken: such a label is better not drawn.
[[nodiscard]] std::vector<std::optional<Eigen::Vector2d>> placeLabels(
    std::span<const LabelRequest> labels, std::span<const PixelBox> obstacles,
    const PlacementOptions& options);

/// True where the interiors of the boxes meet.
[[nodiscard]] bool overlap(const PixelBox& a, const PixelBox& b);

}  // namespace slamscope::engine
