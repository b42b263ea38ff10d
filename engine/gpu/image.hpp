// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/memory.hpp"

namespace slamscope::engine::gpu {

struct ImageInfo {
  vk::Format format = vk::Format::eR8G8B8A8Unorm;
  vk::Extent2D extent = {};
  std::uint32_t layers = 1;
  vk::ImageUsageFlags usage = {};
};

/// 2D image on the device, one layer a view; `view()` is always of an array.
class DeviceImage {
 public:
  DeviceImage(const Core& core, const ImageInfo& info);

  [[nodiscard]] vk::Image handle() const { return *image_; }
  [[nodiscard]] vk::ImageView view() const { return *view_; }
  [[nodiscard]] vk::Extent2D extent() const { return info_.extent; }
  [[nodiscard]] std::uint32_t layers() const { return info_.layers; }
  [[nodiscard]] vk::Format format() const { return info_.format; }
  [[nodiscard]] vk::ImageAspectFlags aspect() const;

 private:
  ImageInfo info_;
  Memory memory_;
  vk::raii::Image image_ = nullptr;
  vk::raii::ImageView view_ = nullptr;
};

/// Sampler of a picture: bilinear, black outside of it.
[[nodiscard]] vk::SamplerCreateInfo bilinearWithBlackBorder();

}  // namespace slamscope::engine::gpu
