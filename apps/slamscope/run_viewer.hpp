// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/lib/view/viewer.hpp"

namespace slamscope::apps {

/// How a viewer is run.
struct ViewerRun {
  bool window = false;
  std::string title;
  std::optional<int> screen;                 ///< full screen on that monitor
  std::vector<std::filesystem::path> files;  ///< that it writes; empty ones don't count
};

/// Runs a viewer to its end: in a window, else into its outputs. Ctrl-C ends it as its own end
/// would.
void runViewer(Viewer& viewer, const ViewerRun& run);

}  // namespace slamscope::apps
