// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/gpu/image.hpp"
#include "engine/gpu/submission.hpp"

namespace slamscope::engine::gpu {

/// What became of a picture that was to be shown.
enum class Presented {
  kShown,  ///< it is, or the display let us wait too long and it was skipped
  kStale,  ///< the surface changed: make a new Swapchain; the picture may have been shown
  kLost,   ///< the surface is gone: make a new surface first
};

/// The images of a surface, of one size. Never changes: when it no longer fits, make another.
class Swapchain {
 public:
  /// `extent` as from extentOf(). The surface must outlive it. low_latency: mailbox where the
  /// surface can, else first in, first out. Throws std::runtime_error where it can't be copied
  /// into.
  Swapchain(const Core& core, vk::SurfaceKHR surface, vk::Extent2D extent, bool low_latency);
  /// Waits for the device.
  ~Swapchain();
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  /// The size that a swapchain of this surface must have; `window` counts where the surface leaves
  /// the choice. None while there is nothing to show it on (minimised).
  [[nodiscard]] static std::optional<vk::Extent2D> extentOf(const Core& core,
                                                            vk::SurfaceKHR surface,
                                                            vk::Extent2D window);

  [[nodiscard]] vk::Extent2D extent() const { return extent_; }

  /// Shows the layers of `picture` (in the layout of copySource()) side by side in `target`, scaled
  /// where the sizes differ, byte for byte where they don't; black around.
  Presented present(const DeviceImage& picture, vk::Rect2D target);
  /// Until the device has read the last picture.
  void wait() { submission_.wait(); }

 private:
  std::optional<std::uint32_t> acquire();
  void record(const DeviceImage& picture, vk::Rect2D target, vk::Image image);

  const Core* core_;
  vk::Extent2D extent_;
  vk::raii::SwapchainKHR chain_ = nullptr;
  std::vector<vk::Image> images_;
  vk::raii::Semaphore acquired_;
  std::vector<vk::raii::Semaphore> drawn_;  ///< one an image: free again when it is acquired again
  bool stale_ = false;
  Submission submission_;
};

}  // namespace slamscope::engine::gpu
