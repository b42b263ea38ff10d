// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "engine/gpu/core.hpp"

namespace slamscope::engine::gpu {

/// Who touches the memory.
enum class MemoryUse {
  kDevice,    ///< the device alone
  kUpload,    ///< written by the host, read by the device
  kReadback,  ///< written by the device, read by the host (cached, else reading is very slow)
};

/// Memory of a device, counted by its Core for as long as it lives.
class Memory {
 public:
  /// None.
  Memory() = default;
  /// Of the best type that fits; host-visible kinds are coherent. Throws std::runtime_error where
  /// the device has none.
  Memory(const Core& core, const vk::MemoryRequirements& requirements, MemoryUse use);
  ~Memory();
  Memory(Memory&& other) noexcept;
  Memory& operator=(Memory&& other) noexcept;

  [[nodiscard]] vk::DeviceMemory operator*() const { return *memory_; }
  /// All of it, for as long as it lives.
  [[nodiscard]] std::byte* map() const;

 private:
  const Core* core_ = nullptr;
  std::size_t bytes_ = 0;
  vk::raii::DeviceMemory memory_ = nullptr;
};

}  // namespace slamscope::engine::gpu
