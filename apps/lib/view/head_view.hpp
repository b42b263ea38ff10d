// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/lib/view/stereo_setup.hpp"
#include "tracking/head_overlay.hpp"
#include "tracking/head_tracker.hpp"
#include "tracking/robot_in_room.hpp"
#include "tracking/tag_search.hpp"

namespace slamscope::apps {

/// What one eye sees, at its own frame's mid-exposure.
struct EyeSight {
  bool picture = false;             ///< its camera gave a frame
  std::chrono::nanoseconds time{};  ///< mid-exposure of that frame, else of the other eye's
  std::optional<tracking::HeadPose> head;
  std::optional<Eigen::Isometry3d> T_eye_map;       ///< once the map has a place
  std::optional<Eigen::Isometry3d> true_T_eye_map;  ///< of a lab
  std::optional<Eigen::Isometry3d> true_T_world_head;
  tracking::OverlayError own_error;  ///< stated, of tracker and registration
};

/// From pairs of frames to where the eyes are: tags in both pictures, the head, the robot's place.
class HeadView {
 public:
  /// `pairs`: frames over which the robot's place is averaged. `setup` must outlive it.
  HeadView(const StereoSetup& setup, int pairs);

  /// Takes a pair of frames.
  void add(const tracking::StereoFrame& frame);

  [[nodiscard]] const std::array<EyeSight, 2>& eyes() const { return eyes_; }
  /// Of the pair added last: the earlier mid-exposure.
  [[nodiscard]] std::chrono::nanoseconds time() const;
  [[nodiscard]] tracking::HeadState state() const;
  [[nodiscard]] const tracking::HeadTracker& tracker() const { return tracker_; }
  /// Where the map lies in the room, once it is known for good.
  [[nodiscard]] const std::optional<tracking::MapPlace>& place() const;
  /// Covariance of tracker's and registration's error at a point of the map as the left eye sees it
  /// now (m², map axes); nothing where it isn't in view.
  [[nodiscard]] std::optional<Eigen::Matrix2d> ownErrorOnFloor(const Eigen::Vector3d& p_map) const;
  [[nodiscard]] int robotPictures() const { return robot_ ? robot_->pictures() : 0; }
  [[nodiscard]] const tracking::Rig& rig() const { return rig_; }  ///< of two eyes

  /// "tracking: 7 of 8 tags, residual 0.08 px, head ±0.6 mm ±0.02°", then the robot's place and
  /// "overlay by tracker and registration alone: ±0.3 px ±1.2 mm".
  [[nodiscard]] std::vector<std::string> statusLines() const;
  [[nodiscard]] std::vector<std::string> problems() const;

 private:
  [[nodiscard]] std::vector<tracking::TagDetection> find(std::size_t eye,
                                                         const tracking::Frame& frame);
  [[nodiscard]] std::chrono::nanoseconds midExposure(std::size_t eye,
                                                     const tracking::Frame& frame) const;
  void look(std::size_t eye);
  void addRobot(std::span<const tracking::HeadPicture> pictures);

  const StereoSetup& setup_;
  tracking::Rig rig_;
  std::vector<tracking::EyeCamera> cameras_;  ///< of rig_
  tracking::HeadTracker tracker_;
  std::vector<tracking::TagSearch> searches_;
  std::array<std::vector<tracking::TagSearch::Place>, 2> robot_seen_;  ///< by each camera, last
  std::optional<tracking::RobotInRoom> robot_;
  std::optional<tracking::MapPlace> origin_;  ///< where there is no robot's tag
  std::array<EyeSight, 2> eyes_;
};

}  // namespace slamscope::apps
