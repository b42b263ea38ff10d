// SPDX-License-Identifier: MIT
#include "engine/window/displays.hpp"

#include <GLFW/glfw3.h>

#include <stdexcept>

#include "engine/window/glfw_window.hpp"

namespace slamscope::engine {

std::vector<Display> listDisplays() {
  (void)GlfwLibrary::get();
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  std::vector<Display> displays;
  for (int i = 0; i < count; ++i) {
    const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
    Display display{.index = i, .name = glfwGetMonitorName(monitors[i])};
    if (mode != nullptr) {
      display.width = mode->width;
      display.height = mode->height;
      display.refresh_hz = mode->refreshRate;
    }
    glfwGetMonitorPos(monitors[i], &display.x, &display.y);
    displays.push_back(std::move(display));
  }
  return displays;
}

Display findDisplay(const std::string& name_or_index) {
  return findDisplay(listDisplays(), name_or_index);
}

Display findDisplay(const std::vector<Display>& displays, const std::string& name_or_index) {
  std::string known;
  std::vector<Display> alike;
  for (const Display& display : displays) {
    if (display.name == name_or_index || std::to_string(display.index) == name_or_index) {
      return display;
    }
    if (display.name.find(name_or_index) != std::string::npos) alike.push_back(display);
    known += (known.empty() ? "" : ", ") + std::to_string(display.index) + " " + display.name;
  }
  if (alike.size() == 1) return alike.front();
  throw std::runtime_error("display " + name_or_index + ": " +
                           (known.empty() ? "there is none" : "there is " + known));
}

}  // namespace slamscope::engine
