// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

#include "apps/lib/view/monitor_options.hpp"
#include "apps/slamscope/flags.hpp"

namespace slamscope::apps {

/// The overhead view as the command line states it.
struct MonitorFlags {
  SimulationFlags simulation;
  std::string registration = "once";
  std::string mode = "all";
  std::string axis = "sigma";
  std::string palette = "paper";
  std::string most_by = "area";
  std::string size;
  std::vector<std::string> allow;
  double k = 3.0;
  double gain = 0.0;         ///< 0: the axis's own
  double map_scale = 0.0;    ///< 0: automatic
  double cluster_cut = 0.0;  ///< 0: automatic
  int focus = -1;            ///< negative: left alone
  double exposure_ms = 0.0;  ///< 0: the camera's own
  MonitorOptions rest;       ///< what needs no translation

  /// Throws std::invalid_argument for what can't be.
  [[nodiscard]] MonitorOptions options() const;
};

/// Camera, registration, SLAM source, what is drawn, outputs.
void addMonitorFlags(CLI::App& verb, MonitorFlags& flags);

/// What is asked of a camera as a device or film: frame rate, size, focus.
void addCaptureFlags(CLI::App& verb, MonitorFlags& flags, const std::string& group);
/// SLAM source, what is drawn, outputs: what any viewer has.
void addViewFlags(CLI::App& verb, MonitorFlags& flags);

/// Runs the view to its end: in a window where `window` says so, else into the outputs.
void runMonitor(const MonitorOptions& options);

}  // namespace slamscope::apps
