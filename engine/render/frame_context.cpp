// SPDX-License-Identifier: MIT
#include "engine/render/frame_context.hpp"

#include <algorithm>
#include <array>

namespace slamscope::engine {

void FrameContext::draw(const std::string& pass, const gpu::Pipeline& pipeline,
                        vk::DescriptorSet pass_set, int vertices, int instances) const {
  auto found = std::ranges::find(stats.passes, pass, &FrameStats::Pass::name);
  if (found == stats.passes.end()) {
    stats.passes.push_back({.name = pass});
    found = stats.passes.end() - 1;
  }
  if (instances == 0) return;
  found->draws += 1;
  found->instances += instances;

  const std::array sets = {frame_set, pass_set};
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline.handle());
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, pipeline.layout(), 0, sets, {});
  commands.draw(static_cast<std::uint32_t>(vertices), static_cast<std::uint32_t>(instances), 0, 0);
}

}  // namespace slamscope::engine
