// SPDX-License-Identifier: MIT
#include "tracking/lab_tag_face.hpp"

#include <cmath>
#include <stdexcept>

#include "tracking/tag_cells.hpp"

namespace slamscope::tracking::lab {

TagFace::TagFace(int id, double size) : cell_(size / 8), half_paper_(0.65 * size) {
  if (!(size > 0)) throw std::invalid_argument("tag size " + std::to_string(size) + " m");
  const TagCells print = tagCells("36h11", id);
  if (print.size != kCells) throw std::logic_error("tag36h11 is not ten cells wide");
  for (int row = 0; row < kCells; ++row)
    for (int column = 0; column < kCells; ++column)
      cells_[row * kCells + column] = print.black(column, row) ? Ink::black : Ink::white;
}

TagFace::TagHit TagFace::intersect(const Ray& ray_tag) const {
  if (!(ray_tag.origin.z() > 0 && ray_tag.direction.z() < 0)) return {};
  const double t = -ray_tag.origin.z() / ray_tag.direction.z();
  const double x = ray_tag.origin.x() + t * ray_tag.direction.x();
  const double y = ray_tag.origin.y() + t * ray_tag.direction.y();
  if (std::abs(x) > half_paper_ || std::abs(y) > half_paper_) return {};
  const int column = static_cast<int>(std::floor(x / cell_ + kCells / 2));
  const int row = static_cast<int>(std::floor(kCells / 2 - y / cell_));
  const bool inside = column >= 0 && column < kCells && row >= 0 && row < kCells;
  return {.t = t, .ink = inside ? cells_[row * kCells + column] : Ink::white};
}

}  // namespace slamscope::tracking::lab
