// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tracking/head_overlay.hpp"
#include "tracking/head_tracker.hpp"
#include "tracking/robot_tag.hpp"

namespace slamscope::tracking {

/// Where the SLAM map lies in the room: the robot's pose at the start, from its tag as the head's
/// cameras see it, held to the floor (x, y, yaw), averaged over pictures and then stored (the
/// paper's initialisation). A picture counts with the covariance of its corners and of the head.
///
///     RobotInRoom robot(rig, readRobotTag("robot.yaml"));
///     robot.add(*tracker.at(picture.time), picture);
///     if (robot.place()) draw(T_eye_world * robot.place()->T_world_map);
class RobotInRoom {
 public:
  /// `pictures`: averaged before it is stored (both eyes count).
  RobotInRoom(const Rig& rig, RobotTag robot, int pictures = 60);
  ~RobotInRoom();
  RobotInRoom(RobotInRoom&&) noexcept;
  RobotInRoom& operator=(RobotInRoom&&) noexcept;

  /// Takes a picture's sight of the robot's tag. Only poses that are tracked count; a robot that
  /// sets off early is registered where it was, or waited for when that was too short.
  void add(const HeadPose& head, const HeadPicture& picture);

  /// Once it is stored.
  [[nodiscard]] const std::optional<MapPlace>& place() const;
  /// What is known so far, stored or not.
  [[nodiscard]] std::optional<MapPlace> soFar() const;
  [[nodiscard]] int pictures() const;  ///< that were averaged
  [[nodiscard]] double residual_px()
      const;  ///< RMS of the tag's corners, of the picture added last
  /// "robot's tag 0 looks 0.176 m wide where 0.200 m is stated (or its height is another)", …
  [[nodiscard]] const std::vector<std::string>& problems() const;
  /// "robot registered: 60 pictures, ±0.4 mm ±0.05°", "registering the robot: picture 12 of 60".
  [[nodiscard]] std::string status() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slamscope::tracking
