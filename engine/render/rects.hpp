// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/render/frame_context.hpp"
#include "engine/render/instances.hpp"
#include "engine/render/view_set.hpp"

namespace slamscope::engine {

/// Filled rectangles of the picture, in the order given, over the scene and under its texts.
class RectPass {
 public:
  explicit RectPass(const PassSetup& setup);

  void update(std::span<const ScreenRect> rects, int& not_drawn);
  void record(const FrameContext& context) const;

 private:
  Instances instances_;
  gpu::Pipeline pipeline_;
};

}  // namespace slamscope::engine
