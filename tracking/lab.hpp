// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "tracking/camera_info.hpp"
#include "tracking/frame_source.hpp"

namespace slamscope::tracking {

/// A real feature: a post standing on the floor.
struct LabPost {
  std::uint64_t id = 0;
  Eigen::Vector2d p_map = Eigen::Vector2d::Zero();  ///< axis of the post, map frame, m
};

/// A board that stands upright on the floor: a wall as high as a laser looks.
struct LabBoard {
  Eigen::Vector2d from_map = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d to_map = Eigen::Vector2d::Zero();    ///< m
  bool glossy = false;                                 ///< lacquered; else wood
};

/// A printed AprilTag (36h11) in the room. Tag frame: origin in the tag's centre; seen upright from
/// the front, x to the right, y up, z out of the paper towards the viewer. So a tag that lies on
/// the floor with z up has T_world_tag = (x, y, 0) and a turn about z. Libapriltag's corners 0..3
/// are then (−,−), (+,−), (+,+), (−,+) times size / 2.
struct LabTag {
  int id = 0;
  double size = 0.20;  ///< side of the black square, m
  Eigen::Isometry3d T_world_tag = Eigen::Isometry3d::Identity();
};

/// What the room looks like in the picture, and what the camera does to it.
struct LabOptions {
  CameraInfo camera;                                                 ///< see defaultLabCamera
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();  ///< see defaultLabCameraPose
  Eigen::Isometry3d T_world_map = Eigen::Isometry3d::Identity();  ///< map's x-y plane is the floor
  std::vector<LabTag> tags;                                       ///< see defaultFloorTags
  std::vector<LabPost> posts;
  double post_radius = 0.02, post_height = 0.18;  ///< m
  std::vector<LabBoard> boards;

  /// Half width (x) and depth (y) of the room, m: walls and a ceiling 2.7 m up. 0: walls far away.
  Eigen::Vector2d walls = Eigen::Vector2d::Zero();
  bool furniture = true;  ///< a few things by the walls, over 2.8 m left and right of the middle

  int robot_tag_id = 0;
  double robot_tag_size = 0.20;  ///< m
  Eigen::Isometry3d T_robot_tag{
      Eigen::Translation3d(0, 0, 0.20)};  ///< robot: x ahead, z up, on the floor
  /// True pose of the robot in the map (x, y, θ) at a time; empty: it stays at the map's origin.
  std::function<Eigen::Vector3d(std::chrono::nanoseconds)> robot_pose_map;

  std::chrono::nanoseconds start{0};  ///< of the run; frame k is exposed around start + k / fps
  double fps = 30;
  std::uint64_t frames = 0;        ///< how many; 0: without end
  std::uint64_t rest_frames = 30;  ///< the first so many show the robot where it is at `start`

  std::chrono::microseconds exposure{8000};
  std::chrono::microseconds readout{0};  ///< rolling shutter, first row to last; 0: global
  double defocus_px = 0.5;               ///< standard deviation of the Gaussian point spread
  double noise = 2.0;                    ///< standard deviation of the grey value, of 255
  double vignette = 0.12;                ///< loss of light in the picture's corners, 0..1
  std::uint64_t seed = 1;                ///< of noise and of the floor's pattern
};

/// 1280 × 720, f = 640 px, principal point off the centre, moderate plumb_bob distortion.
[[nodiscard]] CameraInfo defaultLabCamera();
/// 3 m above the middle of the room (the world's origin), looking down a little askew, as mounted
/// by hand. World x runs to the right in the picture, world y up.
[[nodiscard]] Eigen::Isometry3d defaultLabCameraPose();
/// Eight floor tags, ids 100..107, 0.20 m, left and right of the 3 m × 3 m field that is centred on
/// the world's origin and marked with tape.
[[nodiscard]] std::vector<LabTag> defaultFloorTags();
/// All of the above: a lab without posts, the robot at rest in the middle.
[[nodiscard]] LabOptions defaultLab();

namespace lab {
struct Motion;
}

/// A room with a robot in it, rendered on the CPU: rays through OpenCV's lens model, in double,
/// area sampled. It shares no code with camera_model nor with the engine, so that half a pixel
/// can't cancel. The sensor is linear. Same options, same frame: to the byte, in any order.
class Lab final : public FrameSource {
 public:
  /// Renders what stands still (about a second). Throws std::invalid_argument on options that make
  /// no picture: no size, skewed K, a lens model that can't be inverted in the picture, fps ≤ 0…
  explicit Lab(LabOptions options);
  ~Lab() override;

  [[nodiscard]] std::optional<Frame> next() override;
  void skip(std::uint64_t frames) override { next_ += frames; }
  [[nodiscard]] std::optional<CameraInfo> cameraInfo() const override { return options_.camera; }
  [[nodiscard]] std::optional<std::uint64_t> count() const override;

  /// Frame k, whatever was asked before (one thread at a time).
  [[nodiscard]] Frame frame(std::uint64_t k) const;
  /// Mid-exposure of frame k.
  [[nodiscard]] std::chrono::nanoseconds time(std::uint64_t k) const;
  /// True pose of the robot in the map at mid-exposure of frame k.
  [[nodiscard]] Eigen::Vector3d robotPoseMap(std::uint64_t k) const;
  [[nodiscard]] const LabOptions& options() const { return options_; }

 private:
  struct Parts;
  [[nodiscard]] lab::Motion motion(std::uint64_t k) const;
  LabOptions options_;
  std::unique_ptr<Parts> parts_;
  std::uint64_t next_ = 0;
};

/// The truth as JSON, so that others can check the pixels: image_size, camera_matrix, distortion
/// {model, coefficients}, T_camera_world and T_world_map (4 × 4 rows), features [{id, map, world}],
/// robot_tag {id, size_m, T_robot_tag}, floor_tags [{id, size_m, T_world_tag, corners_world}].
/// Throws std::runtime_error when the file can't be written.
void writeLabTruth(const LabOptions& options, const std::filesystem::path& file);

}  // namespace slamscope::tracking
