// SPDX-License-Identifier: MIT
#include "engine/gpu/memory.hpp"

#include <optional>
#include <stdexcept>
#include <vector>

namespace slamscope::engine::gpu {

namespace {

using Flags = vk::MemoryPropertyFlags;
using Bits = vk::MemoryPropertyFlagBits;

/// Property sets in the order of preference.
std::vector<Flags> wishes(MemoryUse use) {
  const Flags host = Bits::eHostVisible | Bits::eHostCoherent;
  switch (use) {
    case MemoryUse::kDevice:
      return {Bits::eDeviceLocal, {}};
    case MemoryUse::kUpload:
      return {host | Bits::eDeviceLocal, host};
    case MemoryUse::kReadback:
      return {host | Bits::eHostCached, host};
  }
  return {};
}

std::optional<std::uint32_t> findType(const vk::PhysicalDeviceMemoryProperties& memory,
                                      std::uint32_t allowed, Flags wanted) {
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    const bool fits = (allowed & (1U << i)) != 0;
    if (fits && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  }
  return std::nullopt;
}

}  // namespace

vk::raii::DeviceMemory allocate(const Core& core, const vk::MemoryRequirements& requirements,
                                MemoryUse use) {
  for (const Flags wanted : wishes(use)) {
    const auto type = findType(core.memory(), requirements.memoryTypeBits, wanted);
    if (!type) continue;
    try {
      return {core.device(), vk::MemoryAllocateInfo{.allocationSize = requirements.size,
                                                    .memoryTypeIndex = *type}};
    } catch (const vk::OutOfDeviceMemoryError&) {
      // The small heap that both sides see may be full: try the next kind.
    }
  }
  throw std::runtime_error("the Vulkan device has no room for " +
                           std::to_string(requirements.size) + " bytes");
}

}  // namespace slamscope::engine::gpu
