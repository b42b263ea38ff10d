// SPDX-License-Identifier: MIT
#include "engine/window/glfw_window.hpp"

#include <GLFW/glfw3.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <utility>

namespace slamscope::engine {
namespace {

std::string lastError() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "no reason given";
}

std::optional<Key> keyOf(int glfw_key) {
  if (glfw_key >= GLFW_KEY_F1 && glfw_key <= GLFW_KEY_F12) {
    return static_cast<Key>(static_cast<int>(Key::f1) + glfw_key - GLFW_KEY_F1);
  }
  constexpr std::array<std::pair<int, Key>, 14> kKeys = {{{GLFW_KEY_ESCAPE, Key::escape},
                                                          {GLFW_KEY_ENTER, Key::enter},
                                                          {GLFW_KEY_KP_ENTER, Key::enter},
                                                          {GLFW_KEY_TAB, Key::tab},
                                                          {GLFW_KEY_BACKSPACE, Key::backspace},
                                                          {GLFW_KEY_DELETE, Key::remove},
                                                          {GLFW_KEY_LEFT, Key::left},
                                                          {GLFW_KEY_RIGHT, Key::right},
                                                          {GLFW_KEY_UP, Key::up},
                                                          {GLFW_KEY_DOWN, Key::down},
                                                          {GLFW_KEY_PAGE_UP, Key::page_up},
                                                          {GLFW_KEY_PAGE_DOWN, Key::page_down},
                                                          {GLFW_KEY_HOME, Key::home},
                                                          {GLFW_KEY_END, Key::end}}};
  for (const auto& [code, key] : kKeys) {
    if (code == glfw_key) return key;
  }
  return std::nullopt;
}

GlfwWindow::Events& eventsOf(GLFWwindow* window) {
  return *static_cast<GlfwWindow::Events*>(glfwGetWindowUserPointer(window));
}

void onKey(GLFWwindow* window, int key, int, int action, int modifiers) {
  if (action == GLFW_RELEASE) return;
  if (const auto known = keyOf(key)) {
    eventsOf(window).keys.push_back({.key = *known,
                                     .shift = (modifiers & GLFW_MOD_SHIFT) != 0,
                                     .control = (modifiers & GLFW_MOD_CONTROL) != 0,
                                     .alt = (modifiers & GLFW_MOD_ALT) != 0});
  }
}

void onCharacter(GLFWwindow* window, unsigned int code_point) {
  eventsOf(window).keys.push_back({.character = code_point});
}

void onButton(GLFWwindow* window, int button, int action, int modifiers) {
  if (action != GLFW_PRESS) return;
  RawClick click{.button = button, .shift = (modifiers & GLFW_MOD_SHIFT) != 0};
  glfwGetCursorPos(window, &click.point.x(), &click.point.y());
  eventsOf(window).clicks.push_back(click);
}

GLFWmonitor* monitorOf(const WindowOptions& options) {
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  if (options.monitor < 0 || options.monitor >= count) {
    throw std::runtime_error(
        "monitor " + std::to_string(options.monitor) + " was asked for, but " +
        (count == 1 ? "there is one (0)" : "there are " + std::to_string(count) + " (from 0)"));
  }
  return monitors[options.monitor];
}

GLFWwindow* create(const WindowOptions& options) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  // The other screens stay usable while ours is full.
  glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
  if (!options.full_screen) {
    return glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
  }
  GLFWmonitor* monitor = monitorOf(options);
  const GLFWvidmode* mode = glfwGetVideoMode(monitor);
  glfwWindowHint(GLFW_RED_BITS, mode->redBits);
  glfwWindowHint(GLFW_GREEN_BITS, mode->greenBits);
  glfwWindowHint(GLFW_BLUE_BITS, mode->blueBits);
  glfwWindowHint(GLFW_REFRESH_RATE, mode->refreshRate);
  return glfwCreateWindow(mode->width, mode->height, options.title.c_str(), monitor, nullptr);
}

}  // namespace

GlfwLibrary& GlfwLibrary::get() {
  if (!displayAvailable()) {
    throw std::runtime_error(
        "a window was asked for but there is no display: set DISPLAY, or use --output");
  }
  static GlfwLibrary library;
  return library;
}

GlfwLibrary::GlfwLibrary() {
  if (glfwInit() != GLFW_TRUE) {
    throw std::runtime_error("a window was asked for but the display can't be opened (" +
                             lastError() + "): set DISPLAY, or use --output");
  }
}

GlfwLibrary::~GlfwLibrary() {
  glfwTerminate();
}

std::vector<std::string> GlfwLibrary::instanceExtensions() const {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (names == nullptr) {
    throw std::runtime_error("a window was asked for but this display has no Vulkan (" +
                             lastError() + "): use --output");
  }
  return {names, names + count};
}

GlfwWindow::GlfwWindow(const WindowOptions& options) {
  (void)GlfwLibrary::get();
  handle_ = create(options);
  if (handle_ == nullptr) {
    throw std::runtime_error("the window can't be opened: " + lastError());
  }
  glfwSetWindowUserPointer(handle_, &events_);
  glfwSetKeyCallback(handle_, onKey);
  glfwSetCharCallback(handle_, onCharacter);
  glfwSetMouseButtonCallback(handle_, onButton);
}

GlfwWindow::~GlfwWindow() {
  glfwDestroyWindow(handle_);
}

GlfwWindow::Events GlfwWindow::poll() {
  glfwPollEvents();
  return std::exchange(events_, {});
}

bool GlfwWindow::closed() const {
  return glfwWindowShouldClose(handle_) == GLFW_TRUE;
}

bool GlfwWindow::minimised() const {
  return glfwGetWindowAttrib(handle_, GLFW_ICONIFIED) == GLFW_TRUE || sizePx().minCoeff() <= 0;
}

Eigen::Vector2i GlfwWindow::sizePx() const {
  Eigen::Vector2i size;
  glfwGetFramebufferSize(handle_, &size.x(), &size.y());
  return size;
}

Eigen::Vector2d GlfwWindow::pxPerPoint() const {
  Eigen::Vector2i points;
  glfwGetWindowSize(handle_, &points.x(), &points.y());
  return sizePx().cast<double>().cwiseQuotient(points.cwiseMax(1).cast<double>());
}

void GlfwWindow::setTitle(const std::string& title) {
  glfwSetWindowTitle(handle_, title.c_str());
}
void GlfwWindow::resize(int width, int height) {
  glfwSetWindowSize(handle_, width, height);
}

VkSurfaceKHR GlfwWindow::makeSurface(VkInstance instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  if (glfwCreateWindowSurface(instance, handle_, nullptr, &surface) != VK_SUCCESS) {
    throw std::runtime_error("the window has no Vulkan surface (" + lastError() +
                             "); its Gpu must be made with windowInstanceExtensions()");
  }
  return surface;
}

}  // namespace slamscope::engine
