// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracking/registration.hpp"
#include "tracking/tag_scene.hpp"

namespace slamscope::tracking {

/// What one frame has to say.
struct RegistrationView {
  std::vector<TagDetection> floor;    ///< of tags whose place is known
  std::optional<TagDetection> robot;  ///< of the robot's tag
};

/// What is sought, and from what.
struct RegistrationSetup {
  TagLayout layout;
  std::optional<RobotTag> robot;
  std::optional<CameraPose> camera_pose;
  double corner_bias_px = 0;
};

struct AveragedRegistration {
  ScenePose pose;
  Matrix9d covariance = Matrix9d::Zero();  ///< as SceneFit::covariance
  double residual_px = 0;
  int tags = 0;
  bool ambiguous = false;
  std::vector<std::string> problems;  ///< what doesn't fit
  bool found = false;                 ///< else problems says why not
};

/// Camera and robot at rest: all corners of all frames in one least squares, the robot's tag held
/// to its plane.
[[nodiscard]] AveragedRegistration averageViews(const CameraModel& camera,
                                                const RegistrationSetup& setup,
                                                const std::vector<RegistrationView>& views);

/// The map's place (x, y, yaw in the world) by a camera that moves, fused over frames.
class MapAverage {
 public:
  /// Takes the frame in; false where the robot isn't where it was (nothing is taken in then).
  bool add(const Eigen::Isometry3d& T_world_map, const Eigen::Matrix3d& covariance_map_axes);
  void clear() { *this = {}; }

  [[nodiscard]] int frames() const { return frames_; }
  [[nodiscard]] Eigen::Isometry3d pose() const;
  [[nodiscard]] Eigen::Matrix3d covariance() const;  ///< of x, y, yaw in the map's axes

 private:
  int frames_ = 0;
  Eigen::Matrix3d information_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d weighted_ = Eigen::Vector3d::Zero();  // information × (x, y, yaw)
  double first_yaw_ = 0;
};

/// One frame's word on it: camera and map solved for together.
[[nodiscard]] std::optional<SceneFit> fitMapInView(const CameraModel& camera,
                                                   const RegistrationSetup& setup,
                                                   const RegistrationView& view,
                                                   const TagPose& camera_pose);

/// One detection that stands for several of the same tag: medians of the corners.
[[nodiscard]] TagDetection typicalDetection(const std::vector<TagDetection>& seen);

[[nodiscard]] std::string misfit(int id);  ///< "tag 3 does not fit the others: …"

}  // namespace slamscope::tracking
