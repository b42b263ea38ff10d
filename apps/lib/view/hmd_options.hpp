// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "apps/lib/view/eye_layout.hpp"
#include "apps/lib/view/monitor_options.hpp"

namespace slamscope::apps {

/// A request for the view of a head-mounted display, as the command line states it.
struct HmdOptions {
  /// What it shares with the overhead view. `camera`: `lab`, two sources `LEFT,RIGHT`, or one
  /// (side-by-side frames, or a single camera). width, height: of one eye.
  MonitorOptions view;
  std::filesystem::path rig;  ///< rig.yaml; none: guessed
  EyeLayout layout = EyeLayout::side_by_side;
  bool swap_eyes = false;
  std::string display;            ///< name or index; empty: a window of its own
  std::string walk = "walk";      ///< of the lab's head: stand, walk, turn, wander
  std::filesystem::path latency;  ///< CSV: four stamps a frame
};

}  // namespace slamscope::apps
