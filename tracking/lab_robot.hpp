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

  /// What a ray meets of the robot; part −1: misses it. Normal: robot frame.
  [[nodiscard]] Sight trace(const Ray& ray_robot) const;
  /// How bright that is, of a robot that stands there: blue, green, red, of 255.
  [[nodiscard]] Eigen::Array3f colour(const Ray& ray_robot, const Sight& sight,
                                      const Eigen::Isometry3d& T_world_robot) const;
  /// It blocks light like this, standing there.
  [[nodiscard]] static Blocker blocker(const Eigen::Isometry3d& T_world_robot);
  /// Corners of a box (robot frame) that holds all of it.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& bounds() const { return bounds_; }

 private:
  struct Block {
    Prism shape;
    Eigen::Array3f albedo;
  };
  void traceTag(const Ray& ray, Sight& nearest) const;
  void traceBody(const Ray& ray, Sight& nearest) const;
  [[nodiscard]] Eigen::Array3f paint(int part) const;

  std::vector<Block> blocks_;
  std::vector<Cylinder> wheels_;
  TagFace tag_;
  Eigen::Isometry3d T_tag_robot_;
  std::vector<Eigen::Vector3d> bounds_;
  Ball ball_;
  bool tag_on_top_ = false;
};

}  // namespace slamscope::tracking::lab
