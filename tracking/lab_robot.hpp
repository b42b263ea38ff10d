// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tracking/lab_room.hpp"

namespace slamscope::tracking::lab {

/// A small two-wheeled robot with its tag on top. Robot frame: x ahead, y left, z up, origin on the
/// floor between the wheels.
class Robot {
 public:
  explicit Robot(const LabOptions& options);

  /// What a ray sees of the robot; part −1: misses it.
  [[nodiscard]] Sample trace(const Ray& ray_robot, const Eigen::Isometry3d& T_world_robot) const;
  /// It blocks light like this, standing there.
  [[nodiscard]] static Blocker blocker(const Eigen::Isometry3d& T_world_robot);
  /// Corners of a box (robot frame) that holds all of it.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& bounds() const { return bounds_; }

 private:
  struct Surface;
  struct Block {
    Prism shape;
    Eigen::Array3f albedo;
  };
  void traceTag(const Ray& ray, Surface& nearest) const;
  void traceBody(const Ray& ray, Surface& nearest) const;

  std::vector<Block> blocks_;
  std::vector<Cylinder> wheels_;
  TagFace tag_;
  Eigen::Isometry3d T_tag_robot_;
  std::vector<Eigen::Vector3d> bounds_;
  Ball ball_;
  bool tag_on_top_ = false;
};

}  // namespace slamscope::tracking::lab
