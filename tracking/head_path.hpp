// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <functional>

namespace slamscope::tracking {

/// Where a head is at a time: T_world_head, head frame with optical axes (x right, y down, z
/// forward). Smooth and the same at every call.
using HeadPath = std::function<Eigen::Isometry3d(std::chrono::nanoseconds)>;

struct HeadPathOptions {
  Eigen::Vector3d target{0, 0, 0.1};  ///< what is looked at, m, world
  double radius = 2.0;                ///< from the target, over the floor, m
  double height = 1.65;               ///< of the eyes, m
  double start = -1.57079632679;      ///< direction from the target to the head at time 0, rad
  double speed = 0.5;                 ///< of walking, m/s
  double sway = 1;  ///< how much a body sways and nods: 1 about 6 mm and 0.4 degrees; 0 a tripod
  double turn_rate = 2.0943951024;  ///< peak of quick turns, rad/s
  double turn_angle = 0.6;          ///< to both sides, rad
};

/// Stands and looks at the target.
[[nodiscard]] HeadPath standingHead(const HeadPathOptions& options = {});
/// Walks in a circle around the target and looks at it.
[[nodiscard]] HeadPath walkingHead(const HeadPathOptions& options = {});
/// Walks likewise and turns the head to and fro (yaw) about the direction to the target.
[[nodiscard]] HeadPath turningHead(const HeadPathOptions& options = {});
/// Stands for `stand`, walks for `walk`, turns quickly for `turn`, and so on: without jumps.
[[nodiscard]] HeadPath wanderingHead(const HeadPathOptions& options = {},
                                     std::chrono::nanoseconds stand = std::chrono::seconds(3),
                                     std::chrono::nanoseconds walk = std::chrono::seconds(20),
                                     std::chrono::nanoseconds turn = std::chrono::seconds(5));

}  // namespace slamscope::tracking
