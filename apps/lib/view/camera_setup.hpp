// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/lib/run_truth.hpp"
#include "apps/lib/view/monitor_options.hpp"
#include "tracking/frame_source.hpp"
#include "tracking/lab.hpp"
#include "tracking/registration.hpp"

namespace slamscope::apps {

/// The camera of a request, with what is needed to register the map in its pictures.
struct CameraSetup {
  std::unique_ptr<tracking::FrameSource> source;
  tracking::CameraInfo info;
  bool calibrated = true;  ///< false: `info` is a guess
  tracking::RegistrationOptions registration;
  double fps = 30.0;  ///< of the first frames: what a film of them is played at
  double map_scale = 1.0;
  /// Of a lab: its options (the truth of the picture), and where its frames' time starts.
  std::optional<tracking::LabOptions> lab;
  std::vector<std::string> notes;  ///< one line each, for people
};

/// How a run was put into a lab.
struct LabPlacement {
  double map_scale = 1.0;
  std::vector<std::string> notes;  ///< one line each, for people
};
/// Fills in the lab's posts and walls, the robot's motion, the start and T_world_map. Without
/// truth: the floor alone.
[[nodiscard]] LabPlacement placeInLab(tracking::LabOptions& lab, const MonitorOptions& options,
                                      const std::optional<RunTruth>& truth);

/// Opens what the options name. `truth`: of the run to be shown, for the lab. Throws
/// std::runtime_error, one line, where it can't be had.
[[nodiscard]] CameraSetup openCamera(const MonitorOptions& options,
                                     const std::optional<RunTruth>& truth);

}  // namespace slamscope::apps
