// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "engine/gpu/vulkan.hpp"
#include "engine/window/input.hpp"
#include "engine/window/window.hpp"

struct GLFWwindow;

namespace slamscope::engine {

/// GLFW, started as long as somebody holds it. Throws std::runtime_error where there is no display.
class GlfwLibrary {
 public:
  [[nodiscard]] static std::shared_ptr<GlfwLibrary> get();
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
  std::shared_ptr<GlfwLibrary> library_;
  GLFWwindow* handle_ = nullptr;
  Events events_;
};

}  // namespace slamscope::engine
