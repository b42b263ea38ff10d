// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "apps/lib/view/head_view.hpp"
#include "apps/lib/view/monitor_report.hpp"

namespace slamscope::apps {

/// One drawn pair of eyes.
struct HmdFrame {
  const HeadView& head;
  const std::vector<std::string>& problems;
  std::optional<Eigen::Isometry3d> true_T_world_map;  ///< of a lab
  /// Of each eye: tips, errors, drawn features and the filter's part, as in `monitor --report`.
  std::array<FrameReport, 2> eyes;
};

/// A frame of `hmd --report`: the head (state, tags, residual), the robot's place, each eye with
/// T_world_head at its own mid-exposure, and errors against the truth where a lab knows it.
[[nodiscard]] nlohmann::ordered_json hmdFrameJson(const HmdFrame& frame);

}  // namespace slamscope::apps
