// SPDX-License-Identifier: MIT
#include "engine/gpu/image.hpp"

namespace slamscope::engine::gpu {

namespace {

/// A processor draws into rows of texels in its own memory just as well as into any other order.
bool linearWillDo(const Core& core, const ImageInfo& info) {
  if (!core.readInPlace()) return false;
  try {
    return core.physical()
               .getImageFormatProperties(info.format, vk::ImageType::e2D, vk::ImageTiling::eLinear,
                                         info.usage)
               .maxArrayLayers >= info.layers;
  } catch (const vk::FormatNotSupportedError&) {
    return false;
  }
}

}  // namespace

vk::ImageAspectFlags DeviceImage::aspect() const {
  return info_.format == vk::Format::eD32Sfloat ? vk::ImageAspectFlagBits::eDepth
                                                : vk::ImageAspectFlagBits::eColor;
}

DeviceImage::DeviceImage(const Core& core, const ImageInfo& info) : info_(info) {
  const bool linear = info.readable && linearWillDo(core, info);
  image_ = {core.device(), vk::ImageCreateInfo{.imageType = vk::ImageType::e2D,
                                               .format = info.format,
                                               .extent = {info.extent.width, info.extent.height, 1},
                                               .mipLevels = 1,
                                               .arrayLayers = info.layers,
                                               .samples = vk::SampleCountFlagBits::e1,
                                               .tiling = linear ? vk::ImageTiling::eLinear
                                                                : vk::ImageTiling::eOptimal,
                                               .usage = info.usage,
                                               .initialLayout = vk::ImageLayout::eUndefined}};
  memory_ = Memory(core, image_.getMemoryRequirements(),
                   linear ? MemoryUse::kReadback : MemoryUse::kDevice);
  image_.bindMemory(*memory_, 0);
  if (linear) {
    mapped_ = memory_.map();
    layout_ = image_.getSubresourceLayout({.aspectMask = aspect()});
  }
  view_ = {core.device(), vk::ImageViewCreateInfo{.image = *image_,
                                                  .viewType = vk::ImageViewType::e2DArray,
                                                  .format = info.format,
                                                  .subresourceRange = {.aspectMask = aspect(),
                                                                       .levelCount = 1,
                                                                       .layerCount = info.layers}}};
}

std::span<const std::uint8_t> DeviceImage::row(std::uint32_t layer, std::uint32_t row) const {
  const std::byte* start =
      mapped_ + layout_.offset + layer * layout_.arrayPitch + row * layout_.rowPitch;
  return {reinterpret_cast<const std::uint8_t*>(start), std::size_t{info_.extent.width} * 4};
}

vk::SamplerCreateInfo bilinearWithBlackBorder() {
  return {.magFilter = vk::Filter::eLinear,
          .minFilter = vk::Filter::eLinear,
          .addressModeU = vk::SamplerAddressMode::eClampToBorder,
          .addressModeV = vk::SamplerAddressMode::eClampToBorder,
          .addressModeW = vk::SamplerAddressMode::eClampToEdge,
          .borderColor = vk::BorderColor::eFloatOpaqueBlack};
}

}  // namespace slamscope::engine::gpu
