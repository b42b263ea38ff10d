// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/gpu/memory.hpp"

namespace slamscope::engine::gpu {

struct ImageInfo {
  vk::Format format = vk::Format::eR8G8B8A8Unorm;
  vk::Extent2D extent = {};
  std::uint32_t layers = 1;
  vk::ImageUsageFlags usage = {};
  bool readable = false;  ///< by the host where it lies, if that costs the device nothing
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

  /// Its memory is seen by the host: what was asked for, on a device that is a processor.
  [[nodiscard]] bool readable() const { return mapped_ != nullptr; }
  /// A row of a layer of a readable one, four bytes a texel; valid once the device is done and the
  /// image has come to readByHost().
  [[nodiscard]] std::span<const std::uint8_t> row(std::uint32_t layer, std::uint32_t row) const;

 private:
  ImageInfo info_;
  Memory memory_;
  vk::raii::Image image_ = nullptr;
  vk::raii::ImageView view_ = nullptr;
  const std::byte* mapped_ = nullptr;
  vk::SubresourceLayout layout_;  // of the first layer, where mapped
};

/// Sampler of a picture: bilinear, black outside of it.
[[nodiscard]] vk::SamplerCreateInfo bilinearWithBlackBorder();

}  // namespace slamscope::engine::gpu
