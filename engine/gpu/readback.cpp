// SPDX-License-Identifier: MIT
#include "engine/gpu/readback.hpp"

namespace slamscope::engine::gpu {

Readback::Readback(const Core& core, vk::Extent2D extent, std::uint32_t layers)
    : extent_(extent),
      layers_(layers),
      buffer_(core, std::size_t{extent.width} * extent.height * layers * 4,
              vk::BufferUsageFlagBits::eTransferDst, MemoryUse::kReadback) {}

void Readback::record(const vk::raii::CommandBuffer& commands, const DeviceImage& image) const {
  commands.copyImageToBuffer(
      image.handle(), vk::ImageLayout::eTransferSrcOptimal, buffer_.handle(),
      vk::BufferImageCopy{.imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, layers_},
                          .imageExtent = {extent_.width, extent_.height, 1}});
  barrierToHost(commands, vk::PipelineStageFlagBits2::eTransfer,
                vk::AccessFlagBits2::eTransferWrite);
}

std::span<const std::uint8_t> Readback::layer(std::uint32_t index) const {
  const std::size_t bytes = std::size_t{extent_.width} * extent_.height * 4;
  return buffer_.as<const std::uint8_t>((index + 1) * bytes).subspan(index * bytes);
}

}  // namespace slamscope::engine::gpu
