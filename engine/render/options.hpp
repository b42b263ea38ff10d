// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace slamscope::engine {

/// How a frame is drawn.
struct RenderOptions {
  /// Light, dark rims and text halos. Off: every glyph is flat in exactly its colour.
  bool lit = true;
  /// Factor on the opacity of everything that stands in the scene (not of rects and texts), [0, 1].
  float opacity = 1.0F;
  /// m; what is nearer to the eye's plane is not drawn.
  double near_m = 0.01;
};

/// What one frame took.
struct FrameStats {
  struct Pass {
    std::string name;
    int draws = 0;      ///< draw calls, for all views together
    int instances = 0;  ///< what those calls drew: ellipsoids, segments, letters
  };
  std::vector<Pass> passes;  ///< in the order of drawing
  int not_drawn = 0;         ///< glyphs left out because a number in them is not finite
  double cpu_ms = 0.0;       ///< sorting, upload, recording, waiting and reading back
  double gpu_ms = 0.0;       ///< by the device's timestamps

  /// Draw calls of the pass of that name; 0 where there is none.
  [[nodiscard]] int draws(const std::string& pass) const;
};

}  // namespace slamscope::engine
