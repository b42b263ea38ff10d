// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "tracking/lab_lens.hpp"
#include "tracking/lab_painter.hpp"
#include "tracking/lab_robot.hpp"
#include "tracking/lab_room.hpp"

namespace slamscope::tracking::lab {

/// Where camera and robot are while a frame is exposed: as many poses of the one as of the other,
/// evenly spaced in time (see Motion), and who walks through the picture.
struct WalkMotion {
  Motion robot;
  std::vector<Eigen::Isometry3d> T_world_camera;
  std::optional<Eigen::Vector2d> bystander;  ///< m, world, at mid-exposure

  [[nodiscard]] bool operator==(const WalkMotion& other) const;
};

/// Painter for a camera that moves: every pixel is the mean over its own area and its own exposure
/// wherever an edge may pass by, of its four corners elsewhere.
class WalkPainter {
 public:
  WalkPainter(const CameraInfo& camera, const Room& room, const Robot& robot);

  [[nodiscard]] Canvas paint(const WalkMotion& motion) const;

 private:
  struct Scene;  // one motion, ready for rays
  [[nodiscard]] std::vector<Room::Candidates> blocks(const WalkMotion& motion) const;
  [[nodiscard]] const Room::Candidates& seen(const std::vector<Room::Candidates>& blocks,
                                             int column, int row) const;
  [[nodiscard]] static Ray rayOf(const Scene& scene, const Eigen::Vector3d& direction,
                                 std::size_t pose);
  [[nodiscard]] Sight trace(const Scene& scene, const Ray& ray, std::size_t pose,
                            const Room::Candidates& candidates) const;
  [[nodiscard]] Eigen::Array3f colour(const Scene& scene, const Ray& ray, std::size_t pose,
                                      const Sight& sight) const;
  [[nodiscard]] Eigen::Array3f robotsShadow(const Scene& scene, const Eigen::Vector2d& p) const;
  [[nodiscard]] int blurPixels(const WalkMotion& motion) const;

  const Room& room_;
  const Robot& robot_;
  CameraInfo camera_;
  Lens lens_;
};

}  // namespace slamscope::tracking::lab
