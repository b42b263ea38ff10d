// SPDX-License-Identifier: MIT
#include "engine/render/cones.hpp"

#include <algorithm>
#include <cmath>

#include "engine/render/shader_code.hpp"

namespace slamscope::engine {

namespace {

gpu::Pipeline pipeline(const PassSetup& setup, const Instances& instances, bool lit, bool edges) {
  return {setup.core,
          {.vertex = shaderCode("cones_vert"),
           .fragment = shaderCode("cones_frag"),
           .sets = {setup.frame_layout, instances.set().layout()},
           .view_mask = setup.view_mask,
           .depth_test = true,
           .depth_write = !edges,
           .constants = {lit ? VK_TRUE : VK_FALSE, edges ? VK_TRUE : VK_FALSE}}};
}

bool drawable(const Cone& cone) {
  return cone.tip.allFinite() && std::isfinite(cone.height) && std::isfinite(cone.radius) &&
         cone.height > 0.0 && cone.radius > 0.0;
}

}  // namespace

ConePass::ConePass(const PassSetup& setup)
    : instances_(setup.core),
      inside_flat_(pipeline(setup, instances_, false, false)),
      inside_lit_(pipeline(setup, instances_, true, false)),
      edges_flat_(pipeline(setup, instances_, false, true)),
      edges_lit_(pipeline(setup, instances_, true, true)) {}

void ConePass::update(std::span<const Cone> cones, const ViewSet& views, int& not_drawn) {
  std::vector<std::pair<double, interop::ConeGlyph>> sorted;
  for (const Cone& cone : cones) {
    if (!drawable(cone)) {
      ++not_drawn;
      continue;
    }
    sorted.push_back({(views.T_shared_scene() * cone.tip).norm(),
                      {.tip = views.point(cone.tip),
                       .axis = views.direction(Eigen::Vector3d::UnitZ()),
                       .height = static_cast<float>(cone.height),
                       .radius = static_cast<float>(cone.radius),
                       .colour = views.colour(cone.colour)}});
  }
  std::ranges::stable_sort(sorted, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<interop::ConeGlyph> glyphs;
  for (const auto& [distance, glyph] : sorted) glyphs.push_back(glyph);
  instances_.upload<interop::ConeGlyph>(glyphs);
}

void ConePass::recordInside(const FrameContext& context) const {
  context.draw("cones", context.lit ? inside_lit_ : inside_flat_, instances_.set().handle(), 4,
               instances_.count());
}

void ConePass::recordEdges(const FrameContext& context) const {
  context.draw("cone edges", context.lit ? edges_lit_ : edges_flat_, instances_.set().handle(), 4,
               instances_.count());
}

}  // namespace slamscope::engine
