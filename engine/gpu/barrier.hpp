// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/image.hpp"

namespace slamscope::engine::gpu {

/// Who uses an image, how, and in which layout.
struct Use {
  vk::PipelineStageFlags2 stage;
  vk::AccessFlags2 access;
  vk::ImageLayout layout = vk::ImageLayout::eUndefined;
};

/// Nobody before; the content may be lost.
[[nodiscard]] Use unused();
[[nodiscard]] Use copyTarget();
[[nodiscard]] Use copySource();
[[nodiscard]] Use readByHost();
[[nodiscard]] Use sampledInFragment();
[[nodiscard]] Use drawnInto();
[[nodiscard]] Use depthTested();
/// Of buffers: read and written by compute shaders; read by them, by drawing and as arguments of
/// indirect commands.
[[nodiscard]] Use computed();
[[nodiscard]] Use readByAll();
/// For swapchain images, handed to the presentation engine by a semaphore.
[[nodiscard]] Use presented();

/// All layers of `image` from one use to the next.
void barrier(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageAspectFlags aspect,
             const Use& from, const Use& to);
void barrier(const vk::raii::CommandBuffer& commands, const DeviceImage& image, const Use& from,
             const Use& to);

/// Whatever `from` wrote to buffers, `to` sees (layouts play no part).
void barrier(const vk::raii::CommandBuffer& commands, const Use& from, const Use& to);

/// What the device wrote to buffers by copying or computing is seen by the host after the fence.
void barrierToHost(const vk::raii::CommandBuffer& commands, vk::PipelineStageFlags2 stage,
                   vk::AccessFlags2 access);

}  // namespace slamscope::engine::gpu
