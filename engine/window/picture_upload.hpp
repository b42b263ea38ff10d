// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "engine/gpu/buffer.hpp"
#include "engine/gpu/image.hpp"
#include "engine/gpu/submission.hpp"
#include "engine/scene/view.hpp"

namespace slamscope::engine {

/// Brings pictures of the host to the device, one layer each, ready to be presented.
class PictureUpload {
 public:
  explicit PictureUpload(const gpu::Core& core);

  /// All pictures of one size; the result is in the layout of copySource(), valid until the next
  /// upload. Throws std::invalid_argument where there is none, or where sizes differ.
  const gpu::DeviceImage& upload(std::span<const Image> pictures);

 private:
  const gpu::Core* core_;
  gpu::Buffer staging_;
  std::unique_ptr<gpu::DeviceImage> image_;
  gpu::Submission submission_;
};

}  // namespace slamscope::engine
