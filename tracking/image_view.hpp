// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "tracking/frame.hpp"

namespace slamscope::tracking {

/// Somebody else's picture, 8 bits a channel: 1 channel (grey) or 3 (blue, green, red).
struct ImageView {
  const std::uint8_t* pixels = nullptr;
  int width = 0, height = 0;  ///< px
  int channels = 1;
  std::size_t row_bytes = 0;  ///< from one row to the next

  ImageView(const std::uint8_t* first, int columns, int rows, int channel_count)
      : pixels(first),
        width(columns),
        height(rows),
        channels(channel_count),
        row_bytes(static_cast<std::size_t>(columns) * static_cast<std::size_t>(channel_count)) {}
  ImageView(const Frame& frame) : ImageView(frame.bgr.data(), frame.width, frame.height, 3) {}
};

}  // namespace slamscope::tracking
