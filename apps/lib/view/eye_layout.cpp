// SPDX-License-Identifier: MIT
#include "apps/lib/view/eye_layout.hpp"

#include <algorithm>
#include <stdexcept>

namespace slamscope::apps {
namespace {

using engine::Image;
using Byte = std::uint8_t;

std::size_t rowBytes(const Image& picture) {
  return std::size_t{4} * static_cast<std::size_t>(picture.width);
}

/// One row of an eye at half the width.
void halveRow(const Byte* from, int half_width, Byte* to) {
  for (int x = 0; x < half_width; ++x, from += 8, to += 4) {
    for (int c = 0; c < 4; ++c) to[c] = static_cast<Byte>((from[c] + from[c + 4] + 1) / 2);
  }
}

void beside(const Image& left, const Image& right, bool half, Image& both) {
  const std::size_t row = rowBytes(left);
  for (int y = 0; y < left.height; ++y) {
    const std::size_t at = row * static_cast<std::size_t>(y);
    Byte* to = both.rgba.data() + (half ? at : 2 * at);
    if (half) {
      halveRow(left.rgba.data() + at, left.width / 2, to);
      halveRow(right.rgba.data() + at, left.width / 2, to + row / 2);
    } else {
      std::copy_n(left.rgba.data() + at, row, to);
      std::copy_n(right.rgba.data() + at, row, to + row);
    }
  }
}

}  // namespace

EyeLayout eyeLayoutFromName(const std::string& name) {
  if (name == "side-by-side") return EyeLayout::side_by_side;
  if (name == "half-side-by-side") return EyeLayout::half_side_by_side;
  if (name == "top-bottom") return EyeLayout::top_bottom;
  if (name == "anaglyph") return EyeLayout::anaglyph;
  throw std::invalid_argument("layout " + name +
                              ": expected side-by-side, half-side-by-side, top-bottom or anaglyph");
}

EyePixel eyePixel(EyeLayout layout, const Eigen::Vector2i& eye_size, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d size = eye_size.cast<double>();
  const auto beyond = [&pixel](int axis, double extent) { return pixel[axis] >= extent - 0.5; };
  switch (layout) {
    case EyeLayout::side_by_side: {
      const bool right = beyond(0, size.x());
      return {right ? 1 : 0, pixel - Eigen::Vector2d(right ? size.x() : 0.0, 0.0)};
    }
    case EyeLayout::half_side_by_side: {
      const bool right = beyond(0, 0.5 * size.x());
      const double x = pixel.x() - (right ? 0.5 * size.x() : 0.0);
      return {right ? 1 : 0, {2.0 * x + 0.5, pixel.y()}};
    }
    case EyeLayout::top_bottom: {
      const bool below = beyond(1, size.y());
      return {below ? 1 : 0, pixel - Eigen::Vector2d(0.0, below ? size.y() : 0.0)};
    }
    case EyeLayout::anaglyph:
      break;
  }
  return {0, pixel};
}

void layOut(EyeLayout layout, const Image& left, const Image& right, Image& both) {
  if (left.width != right.width || left.height != right.height) {
    throw std::invalid_argument("two eyes of different size can't share a picture");
  }
  if (layout == EyeLayout::half_side_by_side && left.width % 2 != 0) {
    throw std::invalid_argument("half-side-by-side needs an even width");
  }
  both.width = layout == EyeLayout::side_by_side ? 2 * left.width : left.width;
  both.height = layout == EyeLayout::top_bottom ? 2 * left.height : left.height;
  both.rgba.resize(rowBytes(both) * static_cast<std::size_t>(both.height));
  switch (layout) {
    case EyeLayout::side_by_side:
    case EyeLayout::half_side_by_side:
      return beside(left, right, layout == EyeLayout::half_side_by_side, both);
    case EyeLayout::top_bottom:
      std::copy(right.rgba.begin(), right.rgba.end(),
                std::copy(left.rgba.begin(), left.rgba.end(), both.rgba.begin()));
      return;
    case EyeLayout::anaglyph:
      both.rgba = right.rgba;
      for (std::size_t i = 0; i < both.rgba.size(); i += 4) both.rgba[i] = left.rgba[i];
      return;
  }
}

}  // namespace slamscope::apps
