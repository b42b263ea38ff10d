// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/gpu/image.hpp"
#include "engine/gpu/swapchain.hpp"
#include "engine/window/glfw_window.hpp"
#include "engine/window/letterbox.hpp"

namespace slamscope::engine {

/// Brings pictures that are on the device into a window, through all that can happen to a window.
class Presenter {
 public:
  /// Both must outlive it. Throws std::runtime_error where the device can't draw into this window.
  Presenter(const gpu::Core& core, const GlfwWindow& window, bool low_latency);

  /// Shows the picture's layers side by side; the picture is in the layout of copySource(). False
  /// where there is nothing to show it on (minimised).
  bool present(const gpu::DeviceImage& picture);
  /// Until the device has read the last picture.
  void wait();
  /// Surface and swapchain anew.
  void rebuild();
  /// Of the last picture shown.
  [[nodiscard]] const Letterbox& box() const { return box_; }

 private:
  void makeSurface();
  /// A swapchain of the window's present size; none while minimised.
  void fit();

  const gpu::Core* core_;
  const GlfwWindow* window_;
  bool low_latency_;
  vk::raii::SurfaceKHR surface_ = nullptr;
  std::unique_ptr<gpu::Swapchain> swapchain_;
  Letterbox box_;
};

}  // namespace slamscope::engine
