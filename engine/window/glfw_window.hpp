// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/gpu/vulkan.hpp"
#include "engine/window/input.hpp"
#include "engine/window/window.hpp"

struct GLFWwindow;

namespace slamscope::engine {

/// GLFW. Started when first asked for, and then for as long as the program runs: Mesa remembers the
/// connection to the display by its address, and takes a second one at the same address for the
/// first (X error BadRequest, seen with 22.3.6).
class GlfwLibrary {
 public:
  /// Throws std::runtime_error where there is no display.
  [[nodiscard]] static GlfwLibrary& get();
  ~GlfwLibrary();
  GlfwLibrary(const GlfwLibrary&) = delete;
  GlfwLibrary& operator=(const GlfwLibrary&) = delete;

  [[nodiscard]] std::vector<std::string> instanceExtensions() const;

 private:
  GlfwLibrary();
};

/// A press of a mouse button, in screen coordinates of the window.
struct RawClick {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  int button = 0;
  bool shift = false;
};

/// The window as GLFW sees it: input, size and surface; nothing of pictures.
class GlfwWindow {
 public:
  explicit GlfwWindow(const WindowOptions& options);
  ~GlfwWindow();
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  struct Events {
    std::vector<KeyPress> keys;
    std::vector<RawClick> clicks;
  };
  [[nodiscard]] Events poll();
  [[nodiscard]] bool closed() const;
  [[nodiscard]] bool minimised() const;
  [[nodiscard]] Eigen::Vector2i sizePx() const;
  /// From screen coordinates (RawClick) to pixels: 1 except on displays of high density.
  [[nodiscard]] Eigen::Vector2d pxPerPoint() const;
  void setTitle(const std::string& title);
  void resize(int width, int height);
  /// Throws std::runtime_error where the instance lacks windowInstanceExtensions().
  [[nodiscard]] VkSurfaceKHR makeSurface(VkInstance instance) const;

 private:
  GLFWwindow* handle_ = nullptr;
  Events events_;
};

}  // namespace slamscope::engine
