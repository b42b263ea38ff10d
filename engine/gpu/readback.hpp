// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/gpu/barrier.hpp"
#include "engine/gpu/buffer.hpp"

namespace slamscope::engine::gpu {

/// Brings the layers of an image with four bytes a texel to the host.
class Readback {
 public:
  Readback(const Core& core, vk::Extent2D extent, std::uint32_t layers);

  /// `image` is in the layout of copySource().
  void record(const vk::raii::CommandBuffer& commands, const DeviceImage& image) const;
  /// Rows of a layer, valid once the fence of what was recorded is signalled and until the next.
  [[nodiscard]] std::span<const std::uint8_t> layer(std::uint32_t index) const;

 private:
  vk::Extent2D extent_;
  std::uint32_t layers_;
  Buffer buffer_;
};

}  // namespace slamscope::engine::gpu
