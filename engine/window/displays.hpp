// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace slamscope::engine {

/// A monitor, as the window system has it.
struct Display {
  int index = 0;  ///< WindowOptions::monitor; 0 is the main one
  std::string name;
  int width = 0, height = 0;  ///< px, of its present mode
  int refresh_hz = 0;
  int x = 0, y = 0;  ///< upper left corner on the desktop, screen coordinates
};

/// Throws std::runtime_error where there is no display.
[[nodiscard]] std::vector<Display> listDisplays();
/// By index, by name, or by a part of one name. Throws std::runtime_error that lists what there is.
[[nodiscard]] Display findDisplay(const std::string& name_or_index);
/// The same among those given.
[[nodiscard]] Display findDisplay(const std::vector<Display>& displays,
                                  const std::string& name_or_index);

}  // namespace slamscope::engine
