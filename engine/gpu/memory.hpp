// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/core.hpp"

namespace slamscope::engine::gpu {

/// Who touches the memory.
enum class MemoryUse {
  kDevice,    ///< the device alone
  kUpload,    ///< written by the host, read by the device
  kReadback,  ///< written by the device, read by the host (cached, else reading is very slow)
};

/// Memory of the best type that fits; host-visible kinds are coherent. Throws std::runtime_error
/// where the device has none.
[[nodiscard]] vk::raii::DeviceMemory allocate(const Core& core,
                                              const vk::MemoryRequirements& requirements,
                                              MemoryUse use);

}  // namespace slamscope::engine::gpu
