// SPDX-License-Identifier: MIT
#include "engine/gpu/barrier.hpp"

namespace slamscope::engine::gpu {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;

Use unused() {
  return {Stage::eAllCommands, Access::eMemoryWrite, Layout::eUndefined};
}
Use copyTarget() {
  return {Stage::eTransfer, Access::eTransferWrite, Layout::eTransferDstOptimal};
}
Use copySource() {
  return {Stage::eTransfer, Access::eTransferRead, Layout::eTransferSrcOptimal};
}
Use readByHost() {
  return {Stage::eHost, Access::eHostRead, Layout::eGeneral};
}
Use sampledInFragment() {
  return {Stage::eFragmentShader, Access::eShaderSampledRead, Layout::eShaderReadOnlyOptimal};
}
Use drawnInto() {
  return {Stage::eColorAttachmentOutput,
          Access::eColorAttachmentWrite | Access::eColorAttachmentRead,
          Layout::eColorAttachmentOptimal};
}
Use depthTested() {
  return {Stage::eEarlyFragmentTests | Stage::eLateFragmentTests,
          Access::eDepthStencilAttachmentWrite | Access::eDepthStencilAttachmentRead,
          Layout::eDepthAttachmentOptimal};
}
Use computed() {
  return {Stage::eComputeShader,
          Access::eShaderSampledRead | Access::eShaderStorageRead | Access::eShaderStorageWrite};
}
Use readByAll() {
  return {Stage::eComputeShader | Stage::eVertexShader | Stage::eFragmentShader |
              Stage::eDrawIndirect | Stage::eTransfer,
          Access::eShaderSampledRead | Access::eShaderStorageRead | Access::eShaderStorageWrite |
              Access::eIndirectCommandRead | Access::eTransferRead};
}
Use presented() {
  return {Stage::eBottomOfPipe, {}, Layout::ePresentSrcKHR};
}

void barrier(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageAspectFlags aspect,
             const Use& from, const Use& to) {
  const vk::ImageMemoryBarrier2 image_barrier = {
      .srcStageMask = from.stage,
      .srcAccessMask = from.access,
      .dstStageMask = to.stage,
      .dstAccessMask = to.access,
      .oldLayout = from.layout,
      .newLayout = to.layout,
      .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .image = image,
      .subresourceRange = {.aspectMask = aspect,
                           .levelCount = VK_REMAINING_MIP_LEVELS,
                           .layerCount = VK_REMAINING_ARRAY_LAYERS}};
  commands.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &image_barrier});
}

void barrier(const vk::raii::CommandBuffer& commands, const DeviceImage& image, const Use& from,
             const Use& to) {
  barrier(commands, image.handle(), image.aspect(), from, to);
}

void barrier(const vk::raii::CommandBuffer& commands, const Use& from, const Use& to) {
  const vk::MemoryBarrier2 memory_barrier = {.srcStageMask = from.stage,
                                             .srcAccessMask = from.access,
                                             .dstStageMask = to.stage,
                                             .dstAccessMask = to.access};
  commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &memory_barrier});
}

void barrierToHost(const vk::raii::CommandBuffer& commands, vk::PipelineStageFlags2 stage,
                   vk::AccessFlags2 access) {
  const vk::MemoryBarrier2 memory_barrier = {.srcStageMask = stage,
                                             .srcAccessMask = access,
                                             .dstStageMask = Stage::eHost,
                                             .dstAccessMask = Access::eHostRead};
  commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &memory_barrier});
}

}  // namespace slamscope::engine::gpu
