// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/device_info.hpp"
#include "engine/gpu/gpu.hpp"
#include "engine/gpu/validation.hpp"

namespace slamscope::engine::gpu {

/// What Gpu keeps from those who need no Vulkan header. Members are destroyed from the last to the
/// first, as Vulkan wants it.
class Core {
 public:
  explicit Core(const GpuOptions& options);

  [[nodiscard]] const DeviceInfo& info() const { return info_; }
  [[nodiscard]] const MessageLog& log() const { return log_; }
  [[nodiscard]] const vk::raii::Instance& instance() const { return instance_; }
  [[nodiscard]] const vk::raii::PhysicalDevice& physical() const { return physical_; }
  [[nodiscard]] const vk::raii::Device& device() const { return device_; }
  /// The one queue: draws, computes, copies; presents too on every driver we know (ask
  /// physical().getSurfaceSupportKHR(family(), surface)).
  [[nodiscard]] const vk::raii::Queue& queue() const { return queue_; }
  [[nodiscard]] std::uint32_t family() const { return family_; }
  [[nodiscard]] const vk::PhysicalDeviceMemoryProperties& memory() const { return memory_; }
  [[nodiscard]] const vk::PhysicalDeviceLimits& limits() const { return limits_; }
  /// Bytes of the device that are in use now (Memory).
  [[nodiscard]] std::size_t memoryBytes() const { return memory_bytes_; }
  void addMemory(std::size_t bytes) const { memory_bytes_ += bytes; }
  void removeMemory(std::size_t bytes) const { memory_bytes_ -= bytes; }
  /// 64-bit atomics in storage buffers may be used.
  [[nodiscard]] bool wideAtomics() const { return wide_atomics_; }
  /// The device is a processor: images may lie where the host reads them at no cost.
  [[nodiscard]] bool readInPlace() const { return read_in_place_; }

 private:
  MessageLog log_;
  vk::raii::Context loader_;
  vk::raii::Instance instance_;
  vk::raii::DebugUtilsMessengerEXT messenger_ = nullptr;
  vk::raii::PhysicalDevice physical_ = nullptr;
  DeviceInfo info_;
  std::uint32_t family_ = 0;
  vk::PhysicalDeviceMemoryProperties memory_;
  vk::PhysicalDeviceLimits limits_;
  bool wide_atomics_ = false;
  bool read_in_place_ = false;
  mutable std::size_t memory_bytes_ = 0;
  vk::raii::Device device_ = nullptr;
  vk::raii::Queue queue_ = nullptr;
};

}  // namespace slamscope::engine::gpu
