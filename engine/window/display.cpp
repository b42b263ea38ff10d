// SPDX-License-Identifier: MIT
#include "engine/window/display.hpp"

#include <cstdlib>

namespace slamscope::engine {

bool displayAvailable() {
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && *value != '\0') return true;
  }
  return false;
}

}  // namespace slamscope::engine
