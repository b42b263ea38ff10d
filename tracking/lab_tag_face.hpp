// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "tracking/lab_shapes.hpp"

namespace slamscope::tracking::lab {

/// A printed 36h11 tag: a sheet of white paper, 1.3 times the side of the black square, without
/// thickness, seen from its front only.
class TagFace {
 public:
  enum class Ink : std::uint8_t { black, white };

  /// Throws std::invalid_argument for an id that the family doesn't have, or a size ≤ 0.
  TagFace(int id, double size);

  struct TagHit {
    double t = std::numeric_limits<double>::infinity();
    Ink ink = Ink::white;

    explicit operator bool() const { return t < std::numeric_limits<double>::infinity(); }
  };
  [[nodiscard]] TagHit intersect(const Ray& ray_tag) const;
  [[nodiscard]] double halfPaper() const { return half_paper_; }

 private:
  static constexpr int kCells = 10;           // 8 across the black square, one of white around it
  std::array<Ink, kCells * kCells> cells_{};  // rows from the upper edge
  double cell_, half_paper_;
};

}  // namespace slamscope::tracking::lab
