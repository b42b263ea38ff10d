// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "tracking/head_path.hpp"
#include "tracking/lab.hpp"
#include "tracking/stereo_source.hpp"

namespace slamscope::tracking {

/// The lab's room seen by the two cameras on a walking head.
struct StereoLabOptions {
  Rig rig;  ///< see defaultLabRig; readout_s and time_offset_s are those of the true cameras
  /// Room, robot, posts, tags, exposure, defocus, noise, vignette, fps, frames, rest_frames, seed.
  /// Its camera, T_world_camera and readout don't count: those are the rig's and the head's.
  LabOptions room;
  HeadPath head;  ///< T_world_head by time; see head_path.hpp
  /// The right eye is exposed so much after the left (two free-running cameras).
  std::chrono::nanoseconds right_late{0};
  double light = 1;  ///< 1: as in LabOptions; 0.15: dim, and the noise stays what it is
  /// Somebody who walks through the picture: where (x, y; m, world) at a time; a grey pillar, 1.75
  /// m high. Nothing: not there then.
  std::function<std::optional<Eigen::Vector2d>(std::chrono::nanoseconds)> bystander;
};

/// Two cameras of 640 × 480, f 480 px, moderate plumb_bob distortion, 64 mm apart, a little askew
/// as assembled by hand, the head frame between them, optical axes. `scale` makes pictures and f
/// larger (2: 1280 × 960).
[[nodiscard]] Rig defaultLabRig(double scale = 1);
/// Tags on the walls (ids 1..16, 0.30 m, 0.35 to 0.6 m up, where somebody who looks at the robot
/// has them in view; a room of 6.6 m × 5.4 m about the world's origin), the eight of the floor (see
/// defaultFloorTags) and four larger ones before and behind the field (108..111, 0.30 m).
[[nodiscard]] std::vector<LabTag> defaultRoomTags();
/// All of these, and a head that walks around the robot.
[[nodiscard]] StereoLabOptions defaultStereoLab();
/// The layout that those tags are.
[[nodiscard]] TagLayout layoutOf(const std::vector<LabTag>& tags);

/// The stereo camera of the lab: rays through OpenCV's lens model as in Lab, each row and each
/// moment of the exposure from where the head is then. Same options, same frames: to the byte, in
/// any order.
class StereoLab final : public StereoSource {
 public:
  /// Throws std::invalid_argument on options that make no picture.
  explicit StereoLab(StereoLabOptions options);
  ~StereoLab() override;

  [[nodiscard]] std::optional<StereoFrame> next() override;
  [[nodiscard]] std::size_t cameras() const override { return options_.rig.cameras.size(); }
  [[nodiscard]] std::optional<Rig> rig() const override { return options_.rig; }
  [[nodiscard]] std::optional<TagLayout> tags() const override;
  [[nodiscard]] std::optional<std::uint64_t> count() const override;

  /// Frame k of an eye, whatever was asked before (one thread at a time). Its stamp is the true
  /// mid-exposure minus the rig's time_offset.
  [[nodiscard]] Frame frame(std::size_t eye, std::uint64_t k) const;
  [[nodiscard]] StereoFrame pair(std::uint64_t k) const;
  /// True mid-exposure (of the middle row) of frame k of an eye.
  [[nodiscard]] std::chrono::nanoseconds time(std::size_t eye, std::uint64_t k) const;
  /// True poses at a time.
  [[nodiscard]] Eigen::Isometry3d T_world_head(std::chrono::nanoseconds time) const;
  [[nodiscard]] Eigen::Vector3d robotPoseMap(std::chrono::nanoseconds time) const;
  /// Where a point of the world (m) truly falls in frame k of an eye (px, distorted picture), by
  /// OpenCV and with its row's own time. Nothing behind the camera.
  [[nodiscard]] std::optional<Eigen::Vector2d> truePixel(std::size_t eye, std::uint64_t k,
                                                         const Eigen::Vector3d& p_world) const;
  [[nodiscard]] const StereoLabOptions& options() const { return options_; }

 private:
  struct Parts;
  StereoLabOptions options_;
  std::unique_ptr<Parts> parts_;
  std::uint64_t next_ = 0;
};

}  // namespace slamscope::tracking
