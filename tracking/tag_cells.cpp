// SPDX-License-Identifier: MIT
#include "tracking/tag_cells.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagStandard41h12.h>

#include <cstdlib>
#include <memory>
#include <stdexcept>

namespace slamscope::tracking {
namespace {

using FamilyOwner = std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)>;

FamilyOwner printedFamily(std::string name) {
  if (name.starts_with("tag")) name.erase(0, 3);
  if (name == "36h11") return {tag36h11_create(), tag36h11_destroy};
  if (name == "25h9") return {tag25h9_create(), tag25h9_destroy};
  if (name == "Standard41h12") return {tagStandard41h12_create(), tagStandard41h12_destroy};
  throw std::invalid_argument("tag family \"" + name +
                              "\" is unknown; expected 36h11, 25h9 or Standard41h12");
}

}  // namespace

TagCells tagCells(const std::string& family_name, int id) {
  const FamilyOwner family = printedFamily(family_name);
  if (id < 0 || id >= static_cast<int>(family->ncodes)) {
    throw std::invalid_argument("tag family " + family_name + " has ids 0 to " +
                                std::to_string(family->ncodes - 1) + ", not " + std::to_string(id));
  }
  image_u8_t* image = apriltag_to_image(family.get(), id);
  TagCells cells;
  cells.size = image->width;
  cells.across_black = family->width_at_border;
  cells.border = (cells.size - cells.across_black) / 2;
  for (int row = 0; row < image->height; ++row) {
    for (int column = 0; column < image->width; ++column) {
      cells.is_black.push_back(image->buf[row * image->stride + column] < 128);
    }
  }
  // Debian's library keeps image_u8_destroy to itself; this is what it does.
  std::free(image->buf);
  std::free(image);
  return cells;
}

}  // namespace slamscope::tracking
