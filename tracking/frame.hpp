// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace slamscope::tracking {

/// One picture of one camera, as the sensor gave it (distorted).
struct Frame {
  std::chrono::nanoseconds time{};  ///< middle of the exposure, on the source's clock
  std::uint64_t sequence = 0;       ///< the source's count; a gap is a frame that was dropped
  std::string source;               ///< file, device or "lab"
  int width = 0, height = 0;        ///< px
  std::vector<std::uint8_t>
      bgr;  ///< rows from the top, 3 bytes a pixel: blue, green, red; no padding
};

}  // namespace slamscope::tracking
