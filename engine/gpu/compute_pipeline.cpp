// SPDX-License-Identifier: MIT
#include "engine/gpu/compute_pipeline.hpp"

#include "engine/gpu/specialization.hpp"

namespace slamscope::engine::gpu {

ComputePipeline::ComputePipeline(const Core& core, SpirV code,
                                 const std::vector<vk::DescriptorSetLayout>& sets,
                                 const std::vector<std::uint32_t>& constants)
    : layout_(core.device(), vk::PipelineLayoutCreateInfo{}.setSetLayouts(sets)) {
  const vk::raii::ShaderModule shader = makeShader(core, code);
  const Specialization specialization(constants);
  pipeline_ = {
      core.device(), nullptr,
      vk::ComputePipelineCreateInfo{.stage = {.stage = vk::ShaderStageFlagBits::eCompute,
                                              .module = *shader,
                                              .pName = "main",
                                              .pSpecializationInfo = specialization.info()},
                                    .layout = *layout_}};
}

void ComputePipeline::bind(const vk::raii::CommandBuffer& commands,
                           std::span<const vk::DescriptorSet> sets) const {
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
  commands.bindDescriptorSets(
      vk::PipelineBindPoint::eCompute, *layout_, 0,
      vk::ArrayProxy<const vk::DescriptorSet>(static_cast<std::uint32_t>(sets.size()), sets.data()),
      {});
}

}  // namespace slamscope::engine::gpu
