// SPDX-License-Identifier: MIT
#include "engine/scene/label_placement.hpp"

#include <algorithm>
#include <array>

namespace slamscope::engine {
namespace {

PixelBox boxAt(const LabelRequest& label, const Eigen::Vector2d& offset_px) {
  const Eigen::Vector2d centre = label.anchor_px + offset_px;
  return {centre - 0.5 * label.size_px, centre + 0.5 * label.size_px};
}

bool inside(const PixelBox& box, const PixelBox& picture) {
  if ((picture.max_px.array() <= picture.min_px.array()).any()) return true;
  return (box.min_px.array() >= picture.min_px.array()).all() &&
         (box.max_px.array() <= picture.max_px.array()).all();
}

std::vector<Eigen::Vector2d> candidates(const LabelRequest& label,
                                        const PlacementOptions& options) {
  static const std::array<Eigen::Vector2d, 8> kDirections = {
      Eigen::Vector2d{0, 1}, {0, -1}, {1, 0},  {-1, 0},
      Eigen::Vector2d{1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
  std::vector<Eigen::Vector2d> offsets;
  if (label.last_offset_px) offsets.push_back(*label.last_offset_px);
  for (int ring = 0; ring < options.rings; ++ring) {
    const double gap = options.gap_px + ring * label.size_px.y();
    for (const Eigen::Vector2d& direction : kDirections) {
      offsets.push_back(direction.cwiseProduct(0.5 * label.size_px) + gap * direction.normalized());
    }
  }
  return offsets;
}

}  // namespace

bool overlap(const PixelBox& a, const PixelBox& b) {
  return (a.min_px.array() < b.max_px.array()).all() && (b.min_px.array() < a.max_px.array()).all();
}

std::vector<std::optional<Eigen::Vector2d>> placeLabels(std::span<const LabelRequest> labels,
                                                        std::span<const PixelBox> obstacles,
                                                        const PlacementOptions& options) {
  std::vector<PixelBox> taken(obstacles.begin(), obstacles.end());
  std::vector<std::optional<Eigen::Vector2d>> placed;
  placed.reserve(labels.size());
  for (const LabelRequest& label : labels) {
    const auto is_free = [&](const Eigen::Vector2d& offset) {
      const PixelBox box = boxAt(label, offset);
      return inside(box, options.picture) &&
             std::none_of(taken.begin(), taken.end(),
                          [&box](const PixelBox& other) { return overlap(box, other); });
    };
    const auto offsets = candidates(label, options);
    const auto chosen = std::find_if(offsets.begin(), offsets.end(), is_free);
    if (chosen == offsets.end()) {
      placed.emplace_back();
      continue;
    }
    taken.push_back(boxAt(label, *chosen));
    placed.emplace_back(*chosen);
  }
  return placed;
}

}  // namespace slamscope::engine
