// SPDX-License-Identifier: MIT
#pragma once

namespace slamscope::engine {

/// True where $DISPLAY or $WAYLAND_DISPLAY names a display. Asks nothing else: programs without a
/// display never start GLFW.
[[nodiscard]] bool displayAvailable();

}  // namespace slamscope::engine
