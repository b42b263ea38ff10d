// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "engine/gpu/barrier.hpp"
#include "engine/gpu/buffer.hpp"

namespace slamscope::engine::gpu {

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
  std::size_t bytes_per_texel_;
  Buffer staging_;
  std::unique_ptr<DeviceImage> image_;
  bool pending_ = false;
};

}  // namespace slamscope::engine::gpu
