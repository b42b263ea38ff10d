// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/lib/view/monitor.hpp"

namespace slamscope::apps {

/// Shows a monitor in a window until the user closes it or presses q. At the end of the input the
/// last picture stays. Returns when the window is closed.
///
/// Keys: m mode, a axis, + and - gain, e covariance rings, l labels, g legend, f fade, space pause,
/// . one frame, s screenshot, h keys, q or Esc quit.
void runInWindow(Monitor& monitor, const std::string& title);

}  // namespace slamscope::apps
