// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace slamscope::engine {

/// How PairGlyphs get into the picture.
enum class PairWay {
  /// By how many there are: fewer than kFewPairs as quads, else by splatting where the device can.
  chosen,
  /// One ray-cast quad each, by the rasterizer.
  quads,
  /// By a compute shader: the nearest of all glyphs at each pixel by 64-bit atomics, then each
  /// pixel
  /// shaded once. Quads on a device without such atomics, or with too small buffers.
  splats,
};

/// Below it the splatter's fixed costs (it goes over every pixel) outweigh what a quad costs.
constexpr std::size_t kFewPairs = 1000;

/// How a frame is drawn.
struct RenderOptions {
  /// Light, dark rims and text halos. Off: every glyph is flat in exactly its colour.
  bool lit = true;
  /// Factor on the opacity of everything that stands in the scene (not of rects and texts), [0, 1].
  float opacity = 1.0F;
  /// m; what is nearer to the eye's plane is not drawn.
  double near_m = 0.01;
  PairWay pair_way = PairWay::chosen;
};

/// What one frame took.
struct FrameStats {
  struct Pass {
    std::string name;
    int draws = 0;      ///< draw calls, for all views together
    int instances = 0;  ///< what those calls drew: ellipsoids, segments, letters
  };
  /// What became of the scene's PairGlyphs.
  struct Pairs {
    std::size_t all = 0;             ///< pairs that there are
    std::size_t chosen = 0;          ///< that meet the conditions
    std::size_t drawn = 0;           ///< of the chosen, those in the picture of a view
    std::size_t not_finite = 0;      ///< of the chosen, those that have no ellipsoid
    float greatest_growth = 0.0F;    ///< where ranked by it (MostBy): the greatest ratio; else 0
    std::size_t uploaded_bytes = 0;  ///< of points and covariance; 0 where only the viewer moved
    bool splatted = false;
    std::string problem;  ///< why nothing is drawn; one line, empty where nothing is wrong
  };

  Pairs pairs;
  std::vector<Pass> passes;      ///< in the order of drawing
  int not_drawn = 0;             ///< glyphs left out because a number in them is not finite
  double cpu_ms = 0.0;           ///< sorting, upload, recording, waiting and reading back
  double gpu_ms = 0.0;           ///< by the device's timestamps
  std::size_t device_bytes = 0;  ///< of the device's memory, by everything that uses this Gpu

  /// Draw calls of the pass of that name; 0 where there is none.
  [[nodiscard]] int draws(const std::string& pass) const;
};

}  // namespace slamscope::engine
