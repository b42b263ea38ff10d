// SPDX-License-Identifier: MIT
#include "engine/gpu/submission.hpp"

#include <cstdint>
#include <stdexcept>
#include <utility>

namespace slamscope::engine::gpu {

Submission::Submission(const Core& core)
    : core_(&core),
      pool_(core.device(),
            vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                      .queueFamilyIndex = core.family()}),
      fence_(core.device(), vk::FenceCreateInfo{}) {
  vk::raii::CommandBuffers buffers(
      core.device(),
      {.commandPool = *pool_, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1});
  commands_ = std::move(buffers.front());
}

Submission::~Submission() {
  try {
    wait();
  } catch (const std::exception&) {
    // A lost device has nothing left to wait for.
  }
}

const vk::raii::CommandBuffer& Submission::begin() {
  wait();
  commands_.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  return commands_;
}

void Submission::submit(const std::vector<vk::Semaphore>& waits,
                        const std::vector<vk::Semaphore>& signals) {
  commands_.end();
  std::vector<vk::SemaphoreSubmitInfo> wait_infos;
  for (const vk::Semaphore semaphore : waits) {
    wait_infos.push_back({.semaphore = semaphore,
                          .stageMask = vk::PipelineStageFlagBits2::eColorAttachmentOutput |
                                       vk::PipelineStageFlagBits2::eTransfer});
  }
  std::vector<vk::SemaphoreSubmitInfo> signal_infos;
  for (const vk::Semaphore semaphore : signals) {
    signal_infos.push_back(
        {.semaphore = semaphore, .stageMask = vk::PipelineStageFlagBits2::eAllCommands});
  }
  const vk::CommandBufferSubmitInfo buffer = {.commandBuffer = *commands_};
  vk::SubmitInfo2 info;
  info.setWaitSemaphoreInfos(wait_infos)
      .setCommandBufferInfos(buffer)
      .setSignalSemaphoreInfos(signal_infos);
  core_->queue().submit2(info, *fence_);
  pending_ = true;
}

void Submission::wait() {
  if (!pending_) return;
  pending_ = false;
  if (core_->device().waitForFences(*fence_, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess) {
    throw std::runtime_error("the Vulkan device does not answer");
  }
  core_->device().resetFences(*fence_);
}

}  // namespace slamscope::engine::gpu
