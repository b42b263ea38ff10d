// SPDX-License-Identifier: MIT
#include "engine/gpu/image.hpp"

namespace slamscope::engine::gpu {

vk::ImageAspectFlags DeviceImage::aspect() const {
  return info_.format == vk::Format::eD32Sfloat ? vk::ImageAspectFlagBits::eDepth
                                                : vk::ImageAspectFlagBits::eColor;
}

DeviceImage::DeviceImage(const Core& core, const ImageInfo& info) : info_(info) {
  image_ = {core.device(), vk::ImageCreateInfo{.imageType = vk::ImageType::e2D,
                                               .format = info.format,
                                               .extent = {info.extent.width, info.extent.height, 1},
                                               .mipLevels = 1,
                                               .arrayLayers = info.layers,
                                               .samples = vk::SampleCountFlagBits::e1,
                                               .tiling = vk::ImageTiling::eOptimal,
                                               .usage = info.usage,
                                               .initialLayout = vk::ImageLayout::eUndefined}};
  memory_ = Memory(core, image_.getMemoryRequirements(), MemoryUse::kDevice);
  image_.bindMemory(*memory_, 0);
  view_ = {core.device(), vk::ImageViewCreateInfo{.image = *image_,
                                                  .viewType = vk::ImageViewType::e2DArray,
                                                  .format = info.format,
                                                  .subresourceRange = {.aspectMask = aspect(),
                                                                       .levelCount = 1,
                                                                       .layerCount = info.layers}}};
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
