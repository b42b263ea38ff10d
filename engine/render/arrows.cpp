// SPDX-License-Identifier: MIT
#include "engine/render/arrows.hpp"

#include <cmath>
#include <vector>

#include "engine/render/shader_code.hpp"
#include "shaders/interop/glyphs.h"

namespace slamscope::engine {

ArrowPass::ArrowPass(const PassSetup& setup)
    : instances_(setup.core),
      looks_(setup.core,
             {.vertex = shaderCode("arrows_vert"),
              .fragment = shaderCode("arrows_frag"),
              .sets = {setup.frame_layout, instances_.set().layout()},
              .view_mask = setup.view_mask},
             0, Picked::Kind::arrow) {}

void ArrowPass::update(std::span<const Arrow> arrows, const ViewSet& views, int& not_drawn) {
  std::vector<interop::ArrowGlyph> glyphs;
  tags_.clear();
  for (const Arrow& arrow : arrows) {
    const bool finite = arrow.origin.allFinite() && std::isfinite(arrow.heading) &&
                        std::isfinite(arrow.length) && std::isfinite(arrow.width);
    if (!finite) {
      ++not_drawn;
      continue;
    }
    const Eigen::Vector3d ahead(std::cos(arrow.heading), std::sin(arrow.heading), 0.0);
    const Eigen::Vector3d left(-ahead.y(), ahead.x(), 0.0);
    glyphs.push_back({.origin = views.point(arrow.origin),
                      .along = views.direction(arrow.length * ahead),
                      .across = views.direction(0.5 * arrow.width * left),
                      .colour = views.colour(arrow.colour)});
    tags_.push_back(arrow.tag);
  }
  instances_.upload<interop::ArrowGlyph>(glyphs);
}

void ArrowPass::record(const FrameContext& context) const {
  context.draw("arrows", looks_[context.look], instances_.set().handle(), 4, instances_.count());
}

}  // namespace slamscope::engine
