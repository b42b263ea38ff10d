// SPDX-License-Identifier: MIT
#include "engine/render/instances.hpp"

namespace slamscope::engine {

namespace {

constexpr std::size_t kStartBytes = 64 * 1024;

std::vector<gpu::Binding> withInstances(std::vector<gpu::Binding> more) {
  more.insert(more.begin(), gpu::Binding{.binding = 0});
  return more;
}

}  // namespace

Instances::Instances(const gpu::Core& core, std::vector<gpu::Binding> more)
    : buffer_(core, kStartBytes, vk::BufferUsageFlagBits::eStorageBuffer, gpu::MemoryUse::kUpload),
      set_(core, withInstances(std::move(more))) {
  set_.writeBuffer(0, buffer_.handle());
}

void Instances::reserve(std::size_t bytes) {
  if (buffer_.reserve(bytes)) set_.writeBuffer(0, buffer_.handle());
}

}  // namespace slamscope::engine
