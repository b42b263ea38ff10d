// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/gpu/device_info.hpp"

namespace slamscope::engine {

namespace gpu {
class Core;  // engine/gpu/core.hpp: what the engine's own files see of it
}

struct GpuOptions {
  /// Index in listDevices(), or a part of a name in any case. Empty: the first of the fastest kind
  /// (discrete, integrated, virtual, cpu) that can draw.
  std::string device = {};
  /// Core and synchronization validation; needs the Khronos layer. Messages are collected, never
  /// printed.
  bool validation = false;
  /// What a window asks for (glfwGetRequiredInstanceExtensions). Not empty: the device can present.
  std::vector<std::string> instance_extensions = {};
  /// Off: the device is taken for one without 64-bit atomics in storage buffers.
  bool wide_atomics = true;
  /// Off: pictures come to the host by way of a buffer, as from a device that is no processor.
  bool read_in_place = true;
  /// Not 0: the device is taken for one whose texel buffers have no more elements than this, and
  /// whose storage buffers have no more bytes.
  std::uint32_t most_texels = 0;
  std::uint32_t most_storage_bytes = 0;
};

/// The least device that maps of 2,800 points are drawn with as any other (tested): storage buffers
/// as large as Vulkan 1.3 grants everywhere, texel buffers as large as all but a few devices have.
inline constexpr std::uint32_t kLeastStorageBytes = 1U << 27U;
inline constexpr std::uint32_t kLeastTexels = 1U << 24U;

/// A Vulkan device to draw with, shared by everything that draws; used from one thread at a time.
class Gpu {
 public:
  /// Throws NoVulkanDevice, or std::runtime_error where validation is asked for and not installed.
  explicit Gpu(const GpuOptions& options = {});
  ~Gpu();
  Gpu(const Gpu&) = delete;
  Gpu& operator=(const Gpu&) = delete;

  [[nodiscard]] const DeviceInfo& device() const;
  /// Every warning and error of the validation layer so far; none without GpuOptions::validation.
  [[nodiscard]] std::vector<std::string> validationMessages() const;
  [[nodiscard]] gpu::Core& core() const;

 private:
  std::unique_ptr<gpu::Core> core_;
};

}  // namespace slamscope::engine
