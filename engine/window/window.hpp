// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/gpu/gpu.hpp"
#include "engine/render/options.hpp"
#include "engine/scene/glyphs.hpp"
#include "engine/scene/view.hpp"
#include "engine/window/display.hpp"
#include "engine/window/input.hpp"

namespace slamscope::engine {

struct WindowOptions {
  std::string title = "slamscope";
  int width = 1280, height = 720;  ///< of the window's inside; the picture's own size is best
  int monitor = 0;                 ///< for full screen: place in the list of monitors
  bool full_screen = false;
  /// Show the newest picture at each refresh and drop those between (where the display can),
  /// instead of waiting for the refresh: less latency, more work.
  bool low_latency = false;
};

/// What GpuOptions::instance_extensions must name so that its device can draw into windows. Throws
/// std::runtime_error where there is no display or it has no Vulkan.
[[nodiscard]] std::vector<std::string> windowInstanceExtensions();

/// A window that shows pictures, pixel for pixel what Offscreen gives while it has the picture's
/// size, else scaled with its shape kept. Minimised it shows nothing and costs nothing. One thread,
/// the program's main one.
///
///   auto gpu = std::make_shared<Gpu>(GpuOptions{.instance_extensions =
///   windowInstanceExtensions()}); Window window(gpu, {.title = "lab"}); while (window.open()) {
///   for (auto& key : window.poll().keys) …; window.show(views, scene); }
class Window {
 public:
  /// Throws std::runtime_error where there is no display, the monitor does not exist, or the Gpu
  /// was made without windowInstanceExtensions().
  Window(std::shared_ptr<Gpu> gpu, const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// False as soon as the person closed it.
  [[nodiscard]] bool open() const;
  /// What the person did; also lets the window move, resize and close. Call once a frame.
  [[nodiscard]] Input poll();

  /// Draws and shows; two views stand side by side. Throws as Offscreen::draw.
  void show(std::span<const View> views, const Scene& scene, const RenderOptions& options = {});
  /// Shows pictures that are there already (of Offscreen::draw, of a file), all of one size.
  void show(std::span<const Image> pictures);

  /// Of the last show() of a scene.
  [[nodiscard]] const FrameStats& lastStats() const;
  /// Pictures shown per second, over the last second.
  [[nodiscard]] double framesPerSecond() const;

  void setTitle(const std::string& title);
  /// Asks the window system for another size; what becomes of it shows after poll().
  void resize(int width, int height);
  /// Builds surface and swapchain anew, as show() does by itself after their loss.
  void rebuild();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slamscope::engine
