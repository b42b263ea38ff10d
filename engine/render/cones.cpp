// SPDX-License-Identifier: MIT
#include "engine/render/cones.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/render/shader_code.hpp"

namespace slamscope::engine {

namespace {

Looks looksOf(const PassSetup& setup, const Instances& instances, bool edges) {
  return {setup.core,
          {.vertex = shaderCode("cones_vert"),
           .fragment = shaderCode("cones_frag"),
           .sets = {setup.frame_layout, instances.set().layout()},
           .view_mask = setup.view_mask,
           .depth_test = true,
           .depth_write = !edges},
          edges ? VK_TRUE : VK_FALSE,
          Picked::Kind::cone};
}

bool drawable(const Cone& cone) {
  return cone.tip.allFinite() && std::isfinite(cone.height) && std::isfinite(cone.radius) &&
         cone.height > 0.0 && cone.radius > 0.0;
}

}  // namespace

ConePass::ConePass(const PassSetup& setup)
    : instances_(setup.core),
      inside_(looksOf(setup, instances_, false)),
      edges_(looksOf(setup, instances_, true)) {}

void ConePass::update(std::span<const Cone> cones, const ViewSet& views, int& not_drawn) {
  struct Keyed {
    double distance = 0.0;
    interop::ConeGlyph glyph;
    std::uint64_t tag = 0;
  };
  std::vector<Keyed> sorted;
  for (const Cone& cone : cones) {
    if (!drawable(cone)) {
      ++not_drawn;
      continue;
    }
    sorted.push_back({.distance = (views.T_shared_scene() * cone.tip).norm(),
                      .glyph = {.tip = views.point(cone.tip),
                                .axis = views.direction(Eigen::Vector3d::UnitZ()),
                                .height = static_cast<float>(cone.height),
                                .radius = static_cast<float>(cone.radius),
                                .colour = views.colour(cone.colour)},
                      .tag = cone.tag});
  }
  std::ranges::stable_sort(sorted, std::greater<>(), &Keyed::distance);
  std::vector<interop::ConeGlyph> glyphs;
  tags_.clear();
  for (const Keyed& each : sorted) {
    glyphs.push_back(each.glyph);
    tags_.push_back(each.tag);
  }
  instances_.upload<interop::ConeGlyph>(glyphs);
}

void ConePass::recordInside(const FrameContext& context) const {
  context.draw("cones", inside_[context.look], instances_.set().handle(), 4, instances_.count());
}

void ConePass::recordEdges(const FrameContext& context) const {
  context.draw("cone edges", edges_[context.look], instances_.set().handle(), 4,
               instances_.count());
}

}  // namespace slamscope::engine
