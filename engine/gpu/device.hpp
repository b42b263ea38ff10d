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

/// Whether storage buffers take 64-bit atomics: what the splatter needs, and nothing else does.
[[nodiscard]] bool hasWideAtomics(const vk::raii::PhysicalDevice& physical);

struct DeviceRequest {
  std::uint32_t family = 0;
  bool present = false;  ///< adds the swapchain
  bool wide_atomics = false;
};

/// Device with exactly the features the engine uses.
[[nodiscard]] vk::raii::Device makeDevice(const vk::raii::PhysicalDevice& physical,
                                          const DeviceRequest& request);

}  // namespace slamscope::engine::gpu
