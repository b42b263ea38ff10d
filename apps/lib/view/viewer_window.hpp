// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "apps/lib/view/viewer.hpp"

namespace slamscope::apps {

/// Shows a viewer in a window until the user closes it or presses q, or `interrupted` becomes true
/// (Ctrl-C). At the end of the input the last picture stays. Returns when the window is closed,
/// saying whether the input had ended.
///
/// Keys: m mode, a axis, + and - gain, e covariance rings, l labels, g legend, c colours, f fade,
/// space pause, . one frame, s screenshot, h keys, q or Esc quit. A click says which feature or
/// pair is there.
///
/// `screen`: full screen on that one of the list of monitors.
[[nodiscard]] Viewer::Ending runInWindow(Viewer& viewer, const std::string& title,
                                         std::optional<int> screen,
                                         const std::atomic<bool>& interrupted);

}  // namespace slamscope::apps
