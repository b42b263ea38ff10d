// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "tracking/lab_lens.hpp"
#include "tracking/lab_robot.hpp"
#include "tracking/lab_room.hpp"

namespace slamscope::tracking::lab {

/// A picture before the sensor: light per pixel (blue, green, red, 0..255 without rounding).
struct Canvas {
  int width = 0, height = 0;
  std::vector<Eigen::Array3f> pixels;

  [[nodiscard]] Eigen::Array3f& at(int column, int row) {
    return pixels[static_cast<std::size_t>(row) * width + column];
  }
  [[nodiscard]] const Eigen::Array3f& at(int column, int row) const {
    return pixels[static_cast<std::size_t>(row) * width + column];
  }
};

/// Part of a picture, px; right and bottom are outside.
struct Region {
  int left = 0, top = 0, right = 0, bottom = 0;

  [[nodiscard]] bool empty() const { return left >= right || top >= bottom; }
  [[nodiscard]] Region grown(int by, int width, int height) const;
};

/// Where the robot is while a frame is exposed: poses evenly spaced in time, the first when the
/// first row's exposure begins, the last when the last row's ends. One pose: it stands still.
struct Motion {
  std::vector<Eigen::Isometry3d> T_world_robot;
  double exposure = 0, readout = 0;  ///< s

  [[nodiscard]] std::size_t middle() const { return T_world_robot.size() / 2; }
  /// Which pose at a moment of one row's exposure; row and moment in 0..1 from first to last.
  [[nodiscard]] std::size_t at(double row, double moment) const;
};

/// Turns rays into pixels. Every pixel is the mean over its own area (and, for the robot, over its
/// own exposure): by a lattice of samples wherever an edge may pass, by its four corners elsewhere.
class Painter {
 public:
  Painter(const LabOptions& options, const Room& room, const Robot& robot);

  /// All that stands still.
  [[nodiscard]] const Canvas& background() const { return background_; }
  /// Where the robot and its shadow change the picture.
  [[nodiscard]] Region changed(const Motion& motion) const;
  /// Paints the robot and its shadow over the background within a region.
  void paintRobot(Canvas& canvas, const Region& region, const Motion& motion) const;

 private:
  struct Corner;
  struct Corners;
  struct Exposure;
  void paintBackground();
  [[nodiscard]] static Corners traceCorners(const Region& region,
                                            const std::function<Corner(int, int)>& trace);
  [[nodiscard]] Ray rayInWorld(const Eigen::Vector3d& direction) const {
    return {T_world_camera_.translation(), T_world_camera_.linear() * direction};
  }
  /// A solid of the room may be seen in this pixel.
  [[nodiscard]] bool solidsNear(int column, int row) const;
  [[nodiscard]] static Ray rayInRobot(const Eigen::Vector3d& direction, const Exposure& exposure,
                                      std::size_t pose);
  [[nodiscard]] Sight traceRobot(const Eigen::Vector3d& direction, const Exposure& exposure,
                                 std::size_t pose, bool solids) const;
  [[nodiscard]] Eigen::Array3f robotsColour(const Eigen::Vector3d& direction,
                                            const Exposure& exposure, std::size_t pose,
                                            const Sight& sight) const;
  [[nodiscard]] Eigen::Array3f sampleRoom(int column, int row, const Room::Candidates& of) const;
  [[nodiscard]] Eigen::Array3f sampleRobot(int column, int row, const Exposure& exposure,
                                           const Eigen::Array3f& behind) const;
  [[nodiscard]] Eigen::Array3f shade(int column, int row, const Blocker& blocker) const;
  void paintShadow(Canvas& canvas, const Region& region, const Blocker& blocker) const;
  [[nodiscard]] int blurPixels(const Motion& motion) const;

  const Room& room_;
  const Robot& robot_;
  CameraInfo camera_;
  Lens lens_;
  Eigen::Isometry3d T_world_camera_;
  Canvas background_;
  std::vector<bool> solids_;  // per corner of a pixel: sees a solid of the room
};

}  // namespace slamscope::tracking::lab
