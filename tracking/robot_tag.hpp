// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>

namespace slamscope::tracking {

/// The tag that the robot carries. Robot frame: on the floor under the robot, x forward, z up;
/// where it stands when the run starts is the origin of the SLAM map.
struct RobotTag {
  std::string family = "36h11";
  int id = 0;
  double size_m = 0.20;  ///< side of the black square
  /// Default: flat on top, 0.20 m above the floor, the tag's x (to the right of its picture)
  /// forward.
  Eigen::Isometry3d T_robot_tag = Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.20));
};

/// Reads robot.yaml (all fields optional; defaults as above):
///
///     family: 36h11
///     id: 0
///     size_m: 0.20
///     T_robot_tag: {position_m: [0, 0, 0.20], rpy_deg: [0, 0, 0]}   # or quaternion_xyzw, or 4
///     rows of 4
///
/// Throws std::runtime_error naming file, field and what was expected; also for an unknown field.
[[nodiscard]] RobotTag readRobotTag(const std::filesystem::path& file);
void writeRobotTag(const RobotTag& tag, const std::filesystem::path& file);

/// Pose of a camera in the room, and how well it is known.
struct CameraPose {
  Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();
  double sigma_position_m = 0;    ///< of the camera's place, per axis; 0: taken as exact
  double sigma_rotation_rad = 0;  ///< per axis
};

/// Reads camera-pose.yaml: T_world_camera (where the camera is) or T_camera_world, either form of
/// pose.
///
///     T_world_camera: {position_m: [0, 0, 3], rpy_deg: [180, 0, 0]}   # looks straight down
///     sigma_position_m: 0.002    # optional
///     sigma_rotation_deg: 0.05   # optional
///
/// Camera frame: x right, y down, z forward. World: z up, floor at z = 0. Throws std::runtime_error
/// naming file, field and what was expected.
[[nodiscard]] CameraPose readCameraPose(const std::filesystem::path& file);
void writeCameraPose(const CameraPose& pose, const std::filesystem::path& file);

}  // namespace slamscope::tracking
