// SPDX-License-Identifier: MIT
#include "engine/gpu/pipeline.hpp"

#include <array>

#include "engine/gpu/specialization.hpp"

namespace slamscope::engine::gpu {

namespace {

vk::PipelineColorBlendAttachmentState blendState(const PipelineInfo& info) {
  using Factor = vk::BlendFactor;
  using Channel = vk::ColorComponentFlagBits;
  constexpr auto kAll = Channel::eR | Channel::eG | Channel::eB | Channel::eA;
  // Destination alpha stays 1: pictures are opaque.
  return {.blendEnable = info.blend ? VK_TRUE : VK_FALSE,
          .srcColorBlendFactor = Factor::eSrcAlpha,
          .dstColorBlendFactor = Factor::eOneMinusSrcAlpha,
          .colorBlendOp = vk::BlendOp::eAdd,
          .srcAlphaBlendFactor = Factor::eZero,
          .dstAlphaBlendFactor = Factor::eOne,
          .alphaBlendOp = vk::BlendOp::eAdd,
          .colorWriteMask = info.colour_write ? kAll : vk::ColorComponentFlags()};
}

}  // namespace

Pipeline::Pipeline(const Core& core, const PipelineInfo& info)
    : layout_(core.device(), vk::PipelineLayoutCreateInfo{}.setSetLayouts(info.sets)) {
  const vk::raii::ShaderModule vertex = makeShader(core, info.vertex);
  const vk::raii::ShaderModule fragment = makeShader(core, info.fragment);
  const Specialization specialization(info.constants);
  const std::array stages = {
      vk::PipelineShaderStageCreateInfo{.stage = vk::ShaderStageFlagBits::eVertex,
                                        .module = *vertex,
                                        .pName = "main",
                                        .pSpecializationInfo = specialization.info()},
      vk::PipelineShaderStageCreateInfo{.stage = vk::ShaderStageFlagBits::eFragment,
                                        .module = *fragment,
                                        .pName = "main",
                                        .pSpecializationInfo = specialization.info()}};

  const vk::PipelineVertexInputStateCreateInfo vertex_input;
  const vk::PipelineInputAssemblyStateCreateInfo assembly = {
      .topology = vk::PrimitiveTopology::eTriangleStrip};
  const vk::PipelineViewportStateCreateInfo viewport = {.viewportCount = 1, .scissorCount = 1};
  const vk::PipelineRasterizationStateCreateInfo raster = {.lineWidth = 1.0F};
  const vk::PipelineMultisampleStateCreateInfo samples;
  const vk::PipelineDepthStencilStateCreateInfo depth = {
      .depthTestEnable = info.depth_test || info.depth_write ? VK_TRUE : VK_FALSE,
      .depthWriteEnable = info.depth_write ? VK_TRUE : VK_FALSE,
      .depthCompareOp = info.depth_test ? vk::CompareOp::eGreaterOrEqual : vk::CompareOp::eAlways};
  const auto attachment = blendState(info);
  const auto blend = vk::PipelineColorBlendStateCreateInfo{}.setAttachments(attachment);
  const std::array dynamic_states = {vk::DynamicState::eViewport, vk::DynamicState::eScissor};
  const auto dynamic = vk::PipelineDynamicStateCreateInfo{}.setDynamicStates(dynamic_states);
  const auto rendering = vk::PipelineRenderingCreateInfo{.viewMask = info.view_mask,
                                                         .depthAttachmentFormat = info.depth_format}
                             .setColorAttachmentFormats(info.colour_format);

  pipeline_ = {core.device(), nullptr,
               vk::GraphicsPipelineCreateInfo{.pNext = &rendering,
                                              .pVertexInputState = &vertex_input,
                                              .pInputAssemblyState = &assembly,
                                              .pViewportState = &viewport,
                                              .pRasterizationState = &raster,
                                              .pMultisampleState = &samples,
                                              .pDepthStencilState = &depth,
                                              .pColorBlendState = &blend,
                                              .pDynamicState = &dynamic,
                                              .layout = *layout_}
                   .setStages(stages)};
}

}  // namespace slamscope::engine::gpu
