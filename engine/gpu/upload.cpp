// SPDX-License-Identifier: MIT
#include "engine/gpu/upload.hpp"

#include <cstring>
#include <stdexcept>
#include <vector>

namespace slamscope::engine::gpu {

Staging::Staging(const Core& core, std::size_t bytes_per_texel)
    : bytes_per_texel_(bytes_per_texel),
      buffer_(core, bytes_per_texel, vk::BufferUsageFlagBits::eTransferSrc, MemoryUse::kUpload) {}

void Staging::write(vk::Extent2D extent, std::span<const std::byte> texels) {
  const std::size_t bytes = std::size_t{extent.width} * extent.height * bytes_per_texel_;
  if (texels.size() != bytes || bytes == 0) {
    throw std::invalid_argument(
        "a picture of " + std::to_string(extent.width) + " x " + std::to_string(extent.height) +
        " px has " + std::to_string(texels.size()) + " bytes, not " + std::to_string(bytes));
  }
  buffer_.reserve(bytes);
  std::memcpy(buffer_.mapped().data(), texels.data(), bytes);
  extent_ = extent;
}

void Staging::recordCopy(const vk::raii::CommandBuffer& commands, const DeviceImage& image,
                         std::uint32_t layer) const {
  commands.copyBufferToImage(
      buffer_.handle(), image.handle(), vk::ImageLayout::eTransferDstOptimal,
      vk::BufferImageCopy{.imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, layer, 1},
                          .imageExtent = {extent_.width, extent_.height, 1}});
}

Texture::Texture(const Core& core, vk::Format format, std::size_t bytes_per_texel)
    : core_(&core), format_(format), staging_(core, bytes_per_texel) {
  write({1, 1}, std::vector<std::byte>(bytes_per_texel));
}

bool Texture::write(vk::Extent2D extent, std::span<const std::byte> texels) {
  staging_.write(extent, texels);
  const bool renewed = !image_ || image_->extent() != extent;
  if (renewed) {
    image_ = std::make_unique<DeviceImage>(
        *core_, ImageInfo{.format = format_,
                          .extent = extent,
                          .usage = vk::ImageUsageFlagBits::eSampled |
                                   vk::ImageUsageFlagBits::eTransferDst});
  }
  pending_ = true;
  return renewed;
}

void Texture::record(const vk::raii::CommandBuffer& commands) {
  if (!pending_) return;
  pending_ = false;
  barrier(commands, *image_, unused(), copyTarget());
  staging_.recordCopy(commands, *image_, 0);
  barrier(commands, *image_, copyTarget(), sampledInFragment());
}

}  // namespace slamscope::engine::gpu
