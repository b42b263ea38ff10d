// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "apps/lib/view/monitor_report.hpp"
#include "engine/scene/view.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::apps {

/// How a map is laid over a picture.
struct Overlay {
  engine::Pinhole camera;  ///< of the drawn picture
  Eigen::Isometry3d T_camera_map = Eigen::Isometry3d::Identity();
  std::optional<Eigen::Isometry3d> true_T_camera_map;  ///< of a lab
  double map_scale = 1.0;
};

/// Fills in what the report says of the features: tips in the picture, their distance from where
/// the true camera has them (registration alone), and the distance of estimates from true features
/// (SLAM alone).
void measureOverlay(const Overlay& overlay, const slam::Snapshot& snapshot, FrameReport& frame);

}  // namespace slamscope::apps
