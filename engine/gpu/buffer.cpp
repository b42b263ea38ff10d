// SPDX-License-Identifier: MIT
#include "engine/gpu/buffer.hpp"

#include <algorithm>
#include <stdexcept>

namespace slamscope::engine::gpu {

Buffer::Buffer(const Core& core, std::size_t bytes, vk::BufferUsageFlags usage, MemoryUse use)
    : core_(&core), bytes_(std::max<std::size_t>(bytes, 256)), usage_(usage), use_(use) {
  create();
}

bool Buffer::reserve(std::size_t bytes) {
  if (bytes <= bytes_) return false;
  bytes_ = std::max(bytes, bytes_ + bytes_ / 2);
  create();
  return true;
}

vk::raii::BufferView Buffer::texels(vk::Format format) const {
  return {core_->device(),
          vk::BufferViewCreateInfo{.buffer = *buffer_, .format = format, .range = VK_WHOLE_SIZE}};
}

void Buffer::create() {
  buffer_ = {core_->device(), vk::BufferCreateInfo{.size = bytes_, .usage = usage_}};
  memory_ = Memory(*core_, buffer_.getMemoryRequirements(), use_);
  buffer_.bindMemory(*memory_, 0);
  if (use_ != MemoryUse::kDevice) mapped_ = memory_.map();
}

}  // namespace slamscope::engine::gpu
