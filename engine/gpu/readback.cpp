// SPDX-License-Identifier: MIT
#include "engine/gpu/readback.hpp"

#include <algorithm>

namespace slamscope::engine::gpu {

namespace {

std::size_t layerBytes(const DeviceImage& image) {
  return std::size_t{image.extent().width} * image.extent().height * 4;
}

}  // namespace

Readback::Readback(const Core& core)
    : buffer_(core, 0, vk::BufferUsageFlagBits::eTransferDst, MemoryUse::kReadback) {}

void Readback::record(const vk::raii::CommandBuffer& commands, const DeviceImage& image) {
  image_ = &image;
  if (image.readable()) {
    barrier(commands, image, copySource(), readByHost());
    return;
  }
  buffer_.reserve(layerBytes(image) * image.layers());
  commands.copyImageToBuffer(
      image.handle(), vk::ImageLayout::eTransferSrcOptimal, buffer_.handle(),
      vk::BufferImageCopy{
          .imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, image.layers()},
          .imageExtent = {image.extent().width, image.extent().height, 1}});
  barrierToHost(commands, vk::PipelineStageFlagBits2::eTransfer,
                vk::AccessFlagBits2::eTransferWrite);
}

void Readback::copyLayer(std::uint32_t index, std::vector<std::uint8_t>& rgba) const {
  const std::size_t bytes = layerBytes(*image_);
  rgba.resize(bytes);
  if (!image_->readable()) {
    const auto layers = buffer_.as<const std::uint8_t>(bytes * image_->layers());
    std::ranges::copy(layers.subspan(index * bytes, bytes), rgba.begin());
    return;
  }
  auto out = rgba.begin();
  for (std::uint32_t v = 0; v < image_->extent().height; ++v) {
    out = std::ranges::copy(image_->row(index, v), out).out;
  }
}

}  // namespace slamscope::engine::gpu
