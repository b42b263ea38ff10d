// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/gpu/device_info.hpp"
#include "engine/gpu/vulkan.hpp"

namespace slamscope::engine::gpu {

/// A physical device and what a person should know of it.
struct Candidate {
  vk::raii::PhysicalDevice physical;
  DeviceInfo info;
};

/// In the driver's order. Throws NoVulkanDevice where there is none.
[[nodiscard]] std::vector<Candidate> enumerateDevices(const vk::raii::Instance& instance);

/// The one that GpuOptions::device names. Throws NoVulkanDevice with the list of what there is.
[[nodiscard]] Candidate chooseDevice(std::vector<Candidate> candidates, const std::string& wanted);

/// First queue family that draws, computes and copies.
[[nodiscard]] std::uint32_t drawingFamily(const vk::raii::PhysicalDevice& physical);

/// Device with exactly the features the engine uses; `present` adds the swapchain.
[[nodiscard]] vk::raii::Device makeDevice(const vk::raii::PhysicalDevice& physical,
                                          std::uint32_t family, bool present);

}  // namespace slamscope::engine::gpu
