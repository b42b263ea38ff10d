// SPDX-License-Identifier: MIT
#include "engine/gpu/memory.hpp"

#include <optional>
#include <stdexcept>
#include <utility>
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

}  // namespace

Memory::Memory(const Core& core, const vk::MemoryRequirements& requirements, MemoryUse use)
    : core_(&core), bytes_(requirements.size), memory_(allocate(core, requirements, use)) {
  core.addMemory(bytes_);
}

Memory::~Memory() {
  if (core_ != nullptr) core_->removeMemory(bytes_);
}

Memory::Memory(Memory&& other) noexcept
    : core_(std::exchange(other.core_, nullptr)),
      bytes_(other.bytes_),
      memory_(std::move(other.memory_)) {}

Memory& Memory::operator=(Memory&& other) noexcept {
  std::swap(core_, other.core_);
  std::swap(bytes_, other.bytes_);
  std::swap(memory_, other.memory_);
  return *this;
}

std::byte* Memory::map() const {
  return static_cast<std::byte*>(memory_.mapMemory(0, VK_WHOLE_SIZE));
}

}  // namespace slamscope::engine::gpu
