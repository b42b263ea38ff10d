// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tracking/camera_model.hpp"
#include "tracking/robot_tag.hpp"
#include "tracking/tag_detector.hpp"
#include "tracking/tag_layout.hpp"
#include "tracking/tag_pose.hpp"

namespace slamscope::tracking {

enum class RegistrationState {
  searching,    ///< waits for the tags it needs
  registering,  ///< gathers frames, k of N
  registered,
  ambiguous,  ///< two poses fit the tags seen: there is a result, but it may be the wrong one
  lost        ///< continuous: was registered, sees no tags now
};
[[nodiscard]] const char* name(RegistrationState state);

/// Where the map's place comes from.
enum class RegistrationMode {
  plane,     ///< camera known over the floor; the robot's tag held to its plane (x, y, yaw)
  layout,    ///< the map starts at the origin of the mapped tags' world; no robot's tag
  free_tag,  ///< neither camera pose nor floor tags: full pose of the robot's tag. 50 times worse
};
[[nodiscard]] const char* name(RegistrationMode mode);

struct RegistrationOptions {
  /// false: registered once from the first frames, then stored (the paper's way; the camera
  /// stands). true: the camera moves and is found anew in each frame from the mapped tags.
  bool continuous = false;
  int frames = 30;  ///< averaged before start
  /// Absent: the map starts at the origin of `layout`'s world (or of T_camera_world's).
  std::optional<RobotTag> robot = RobotTag{};
  std::optional<CameraPose> camera_pose =
      std::nullopt;       ///< measured beforehand; with `layout` too, a prior for it
  TagLayout layout = {};  ///< tags of the floor, room or board; may be empty
  /// What averaging can't remove: bias of a corner, the same in each frame, px per axis.
  double corner_bias_px = 0.01;
  /// Side of the square about the map's origin for which errors are stated, m.
  double extent_m = 3;
};

struct RegistrationResult {
  RegistrationMode mode = RegistrationMode::plane;
  Eigen::Isometry3d T_camera_map = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_world_map = Eigen::Isometry3d::Identity();
  /// Of T_camera_map's right perturbation, translation (m) first, map axes.
  Matrix6d covariance = Matrix6d::Zero();
  double residual_px = 0;  ///< RMS over all corners used
  int frames = 0;          ///< that were averaged
  int tags = 0;            ///< in view, that fit
  /// Predicted from the covariance, root of the mean square over the floor (extent_m) in view: how
  /// far the overlay is drawn from where it belongs, in the picture and on the floor.
  double overlay_error_px = 0;
  double floor_error_mm = 0;
};

/// Registers the SLAM map in the camera's picture: T_camera_map, the map's origin being the robot's
/// pose at the start. Time is passed in, nothing runs by itself.
///
///     Registration registration({.camera_pose = readCameraPose("camera-pose.yaml")}, camera);
///     while (auto frame = source->next()) {
///       registration.add(frame->time, detector.detect(*frame));
///       if (auto result = registration.result()) draw(result->T_camera_map);
///     }
class Registration {
 public:
  /// Throws std::invalid_argument where nothing could ever register (no robot's tag, camera pose
  /// nor layout; tags of two families; an id that is the robot's and the floor's).
  Registration(RegistrationOptions options, CameraModel camera);

  /// The tags of one frame, in order of time.
  void add(std::chrono::nanoseconds time, std::span<const TagDetection> detections);
  /// There are no more frames: registers with those gathered so far, if any.
  void settle();

  [[nodiscard]] RegistrationState state() const { return state_; }
  [[nodiscard]] RegistrationMode mode() const { return mode_; }
  /// Present when registered or ambiguous: of the frame added last when continuous, else stored.
  [[nodiscard]] const std::optional<RegistrationResult>& result() const { return result_; }
  /// One line for a person: "registered (plane): 30 frames, residual 0.04 px, overlay ±0.06 px,
  /// floor ±0.3 mm", "registering: frame 12 of 30", "searching: no robot's tag 0 (36h11) in view".
  [[nodiscard]] std::string status() const;
  /// What doesn't fit, named: "tag 3 does not fit the others: moved, doubled or of another size",
  /// "robot's tag 0 looks 0.176 m wide where 0.200 m is stated". Empty when all is well.
  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }

  ~Registration();
  Registration(Registration&&) noexcept;
  Registration& operator=(Registration&&) noexcept;

 private:
  struct Parts;  // what has been gathered
  void gather(std::span<const TagDetection> detections);
  void finish();
  void follow(std::chrono::nanoseconds time, std::span<const TagDetection> detections);
  void publish(RegistrationResult result, bool ambiguous);

  RegistrationOptions options_;
  CameraModel camera_;
  RegistrationMode mode_ = RegistrationMode::plane;
  RegistrationState state_ = RegistrationState::searching;
  std::optional<RegistrationResult> result_;
  std::vector<std::string> problems_;
  std::unique_ptr<Parts> parts_;
};

/// Σ_uv = J Σ Jᵀ: how uncertain the pixel of a map point is by registration alone, px². Nothing
/// where the point isn't in view.
[[nodiscard]] std::optional<Eigen::Matrix2d> overlayCovariance(
    const CameraModel& camera, const RegistrationResult& registration,
    const Eigen::Vector3d& p_map);
/// The same as an ellipse on the map's floor that looks like Σ_uv: covariance of x and y, m², map
/// axes.
[[nodiscard]] std::optional<Eigen::Matrix2d> overlayCovarianceOnFloor(
    const CameraModel& camera, const RegistrationResult& registration,
    const Eigen::Vector3d& p_map);

}  // namespace slamscope::tracking
