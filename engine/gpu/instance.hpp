// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "engine/gpu/validation.hpp"

namespace slamscope::engine::gpu {

/// Opens the loader. Throws NoVulkanDevice where there is none.
[[nodiscard]] vk::raii::Context openLoader();

/// Vulkan 1.3 instance; `log` not null turns core and synchronization validation on. Throws
/// NoVulkanDevice where no driver is installed, std::runtime_error where validation isn't.
[[nodiscard]] vk::raii::Instance makeInstance(const vk::raii::Context& loader,
                                              std::span<const std::string> extensions,
                                              MessageLog* log);

}  // namespace slamscope::engine::gpu
