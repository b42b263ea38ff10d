// SPDX-License-Identifier: MIT
#include "tracking/lab_tag_face.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>

namespace slamscope::tracking::lab {

TagFace::TagFace(int id, double size) : cell_(size / 8), half_paper_(0.65 * size) {
  if (!(size > 0)) throw std::invalid_argument("tag size " + std::to_string(size) + " m");
  const std::unique_ptr<apriltag_family_t, decltype(&tag36h11_destroy)> family(tag36h11_create(),
                                                                               tag36h11_destroy);
  if (id < 0 || id >= static_cast<int>(family->ncodes))
    throw std::invalid_argument("tag36h11 has no id " + std::to_string(id));
  const std::unique_ptr<image_u8_t, void (*)(image_u8_t*)> image(
      apriltag_to_image(family.get(), id), [](image_u8_t* picture) {
        // Debian's library keeps image_u8_destroy to itself; this is what it does.
        std::free(picture->buf);
        std::free(picture);
      });
  if (image->width != kCells || image->height != kCells)
    throw std::logic_error("tag36h11 is not ten cells wide");
  for (int row = 0; row < kCells; ++row)
    for (int column = 0; column < kCells; ++column)
      cells_[row * kCells + column] =
          image->buf[row * image->stride + column] > 127 ? Ink::white : Ink::black;
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
