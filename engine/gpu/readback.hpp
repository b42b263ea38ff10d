// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/gpu/barrier.hpp"
#include "engine/gpu/buffer.hpp"

namespace slamscope::engine::gpu {

/// Brings the layers of an image with four bytes a texel to the host: by way of a buffer, or from
/// where they lie where the image is readable().
class Readback {
 public:
  explicit Readback(const Core& core);

  /// `image` is in the layout of copySource(), and the device is not working. It must live until
  /// layers were copied.
  void record(const vk::raii::CommandBuffer& commands, const DeviceImage& image);
  /// Rows of a layer, once the fence of what was recorded last is signalled.
  void copyLayer(std::uint32_t index, std::vector<std::uint8_t>& rgba) const;

 private:
  Buffer buffer_;
  const DeviceImage* image_ = nullptr;
};

}  // namespace slamscope::engine::gpu
