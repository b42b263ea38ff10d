// SPDX-License-Identifier: MIT
#include "engine/window/picture_upload.hpp"

#include <cstring>
#include <stdexcept>
#include <string>

#include "engine/gpu/barrier.hpp"

namespace slamscope::engine {
namespace {

void requireOneSize(std::span<const Image> pictures) {
  if (pictures.empty()) throw std::invalid_argument("there is no picture to show");
  const Image& first = pictures.front();
  for (const Image& picture : pictures) {
    const auto bytes = std::size_t{4} * static_cast<std::size_t>(picture.width) *
                       static_cast<std::size_t>(picture.height);
    if (picture.width != first.width || picture.height != first.height || picture.width <= 0 ||
        picture.height <= 0 || picture.rgba.size() != bytes) {
      throw std::invalid_argument("a picture of " + std::to_string(picture.width) + " x " +
                                  std::to_string(picture.height) + " px with " +
                                  std::to_string(picture.rgba.size()) + " bytes can't be shown");
    }
  }
}

}  // namespace

PictureUpload::PictureUpload(const gpu::Core& core)
    : core_(&core),
      staging_(core, 4, vk::BufferUsageFlagBits::eTransferSrc, gpu::MemoryUse::kUpload),
      submission_(core) {}

const gpu::DeviceImage& PictureUpload::upload(std::span<const Image> pictures) {
  requireOneSize(pictures);
  const vk::Extent2D extent = {static_cast<std::uint32_t>(pictures.front().width),
                               static_cast<std::uint32_t>(pictures.front().height)};
  const auto layers = static_cast<std::uint32_t>(pictures.size());
  const auto& commands = submission_.begin();  // waits: the staging memory is free
  if (!image_ || image_->extent() != extent || image_->layers() != layers) {
    image_ = std::make_unique<gpu::DeviceImage>(
        *core_, gpu::ImageInfo{.extent = extent,
                               .layers = layers,
                               .usage = vk::ImageUsageFlagBits::eTransferDst |
                                        vk::ImageUsageFlagBits::eTransferSrc |
                                        vk::ImageUsageFlagBits::eSampled});
  }
  const std::size_t bytes = pictures.front().rgba.size();
  staging_.reserve(bytes * layers);
  for (std::uint32_t layer = 0; layer < layers; ++layer) {
    std::memcpy(staging_.mapped().data() + layer * bytes, pictures[layer].rgba.data(), bytes);
  }
  gpu::barrier(commands, *image_, gpu::unused(), gpu::copyTarget());
  commands.copyBufferToImage(
      staging_.handle(), image_->handle(), vk::ImageLayout::eTransferDstOptimal,
      vk::BufferImageCopy{.imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, layers},
                          .imageExtent = {extent.width, extent.height, 1}});
  gpu::barrier(commands, *image_, gpu::copyTarget(), gpu::copySource());
  submission_.submit();
  return *image_;
}

}  // namespace slamscope::engine
