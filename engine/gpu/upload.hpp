// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "engine/gpu/barrier.hpp"
#include "engine/gpu/buffer.hpp"

namespace slamscope::engine::gpu {

/// A picture of the host on its way to the device.
class Staging {
 public:
  Staging(const Core& core, std::size_t bytes_per_texel);

  /// Copies tightly packed rows; the device must not be reading. Throws std::invalid_argument where
  /// the number of bytes is not that of the extent.
  void write(vk::Extent2D extent, std::span<const std::byte> texels);
  /// Records the copy over `layer` of an image of the same extent in the layout of copyTarget().
  void recordCopy(const vk::raii::CommandBuffer& commands, const DeviceImage& image,
                  std::uint32_t layer) const;

 private:
  std::size_t bytes_per_texel_;
  vk::Extent2D extent_;
  Buffer buffer_;
};

/// A one-layer image that shaders sample and the host fills. Starts as one texel, grows or shrinks
/// with what is written into it.
class Texture {
 public:
  Texture(const Core& core, vk::Format format, std::size_t bytes_per_texel);

  /// Copies the texels (tightly packed rows) into staging memory; record() sends them on. True
  /// where the image is a new one: then descriptors must be written again. The device must not be
  /// using it.
  bool write(vk::Extent2D extent, std::span<const std::byte> texels);
  /// Records the copy of what was written since the last record(), if anything was.
  void record(const vk::raii::CommandBuffer& commands);

  [[nodiscard]] vk::ImageView view() const { return image_->view(); }
  [[nodiscard]] vk::Extent2D extent() const { return image_->extent(); }

 private:
  const Core* core_;
  vk::Format format_;
  Staging staging_;
  std::unique_ptr<DeviceImage> image_;
  bool pending_ = false;
};

}  // namespace slamscope::engine::gpu
