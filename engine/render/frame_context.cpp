// SPDX-License-Identifier: MIT
#include "engine/render/frame_context.hpp"

#include <algorithm>
#include <array>

namespace slamscope::engine {

FrameStats::Pass& FrameContext::counted(const std::string& pass) const {
  auto found = std::ranges::find(stats.passes, pass, &FrameStats::Pass::name);
  if (found == stats.passes.end()) {
    stats.passes.push_back({.name = pass});
    found = stats.passes.end() - 1;
  }
  return *found;
}

void FrameContext::bind(const gpu::Pipeline& pipeline, vk::DescriptorSet pass_set) const {
  const std::array sets = {frame_set, pass_set};
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline.handle());
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, pipeline.layout(), 0, sets, {});
}

void FrameContext::draw(const std::string& pass, const gpu::Pipeline& pipeline,
                        vk::DescriptorSet pass_set, int vertices, int instances) const {
  FrameStats::Pass& count = counted(pass);
  if (instances == 0) return;
  count.draws += 1;
  count.instances += instances;
  bind(pipeline, pass_set);
  commands.draw(static_cast<std::uint32_t>(vertices), static_cast<std::uint32_t>(instances), 0, 0);
}

void FrameContext::drawIndirect(const std::string& pass, const gpu::Pipeline& pipeline,
                                vk::DescriptorSet pass_set, vk::Buffer arguments,
                                std::size_t offset) const {
  counted(pass).draws += 1;
  bind(pipeline, pass_set);
  commands.drawIndirect(arguments, offset, 1, sizeof(vk::DrawIndirectCommand));
}

}  // namespace slamscope::engine
