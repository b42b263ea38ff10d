// SPDX-License-Identifier: MIT
#include "engine/render/rects.hpp"

#include <vector>

#include "engine/render/shader_code.hpp"
#include "shaders/interop/glyphs.h"

namespace slamscope::engine {

RectPass::RectPass(const PassSetup& setup)
    : instances_(setup.core),
      pipeline_(setup.core, {.vertex = shaderCode("rects_vert"),
                             .fragment = shaderCode("rects_frag"),
                             .sets = {setup.frame_layout, instances_.set().layout()},
                             .view_mask = setup.view_mask}) {}

void RectPass::update(std::span<const ScreenRect> rects, int& not_drawn) {
  std::vector<interop::RectGlyph> glyphs;
  for (const ScreenRect& rect : rects) {
    if (!rect.min_px.allFinite() || !rect.max_px.allFinite()) {
      ++not_drawn;
      continue;
    }
    glyphs.push_back({.min_px = toVec2(rect.min_px),
                      .max_px = toVec2(rect.max_px),
                      .colour = toVec4(rect.colour)});
  }
  instances_.upload<interop::RectGlyph>(glyphs);
}

void RectPass::record(const FrameContext& context) const {
  context.draw("rects", pipeline_, instances_.set().handle(), 4, instances_.count());
}

}  // namespace slamscope::engine
