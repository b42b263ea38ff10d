// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "tracking/stereo_lab.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::AngleAxisd, Eigen::Isometry3d, Eigen::Vector3d;

constexpr double kRightAngleHalf = std::numbers::pi / 2;
constexpr double kInDegrees = std::numbers::pi / 180;
constexpr double kWallX = 3.3, kWallY = 2.7;  // m
constexpr double kPaper = 0.002;              // of the tags before their wall, m

CameraInfo labEye(const char* name, double scale, double cx, double cy) {
  CameraInfo camera;
  camera.name = name;
  camera.width = static_cast<int>(std::lround(640 * scale));
  camera.height = static_cast<int>(std::lround(480 * scale));
  camera.K << 480 * scale, 0, (cx + 0.5) * scale - 0.5, 0, 480 * scale, (cy + 0.5) * scale - 0.5, 0,
      0, 1;
  camera.D = {-0.11, 0.03, 0.0005, -0.0003, -0.004};
  return camera;
}

/// Hung on the wall that lies in a direction (rad) from the middle, `aside` along it.
Isometry3d onWall(double direction, double distance, double aside, double height, double roll) {
  return Isometry3d(AngleAxisd(direction, Vector3d::UnitZ())) *
         Eigen::Translation3d(distance, aside, height) *
         AngleAxisd(-kRightAngleHalf, Vector3d::UnitZ()) *
         AngleAxisd(kRightAngleHalf, Vector3d::UnitX()) * AngleAxisd(roll, Vector3d::UnitZ());
}

}  // namespace

Rig defaultLabRig(double scale) {
  Rig rig;
  rig.name = "lab";
  rig.cameras.push_back({.info = labEye("lab_left", scale, 321.7, 238.3), .display = {}});
  rig.cameras.push_back({.info = labEye("lab_right", scale, 316.9, 241.2), .display = {}});
  rig.T_right_left = Eigen::Translation3d(-0.064, 0.0008, -0.0006) *
                     AngleAxisd(0.4 * kInDegrees, Vector3d::UnitY()) *
                     AngleAxisd(-0.3 * kInDegrees, Vector3d::UnitX()) *
                     AngleAxisd(0.2 * kInDegrees, Vector3d::UnitZ());
  rig.T_head_left.translation().x() = -0.032;
  return rig;
}

std::vector<LabTag> defaultRoomTags() {
  struct Place {
    double aside, height, degrees;
  };
  constexpr Place kPlaces[] = {
      {-1.75, 0.36, 2}, {-0.6, 0.60, -3}, {0.55, 0.40, 1}, {1.7, 0.62, -2}};
  std::vector<LabTag> tags;
  for (int wall = 0; wall < 4; ++wall)
    for (const Place& place : kPlaces)
      tags.push_back(
          {.id = 1 + static_cast<int>(tags.size()),
           .size = 0.30,
           .T_world_tag = onWall(wall * kRightAngleHalf, (wall % 2 == 0 ? kWallX : kWallY) - kPaper,
                                 place.aside + 0.07 * wall, place.height,
                                 (place.degrees - wall) * kInDegrees)});
  for (const LabTag& tag : defaultFloorTags()) tags.push_back(tag);
  constexpr Place kBeforeAndBehind[] = {
      {-0.75, 1.86, 5}, {0.8, 1.9, -8}, {-0.8, -1.88, 3}, {0.7, -1.85, -4}};
  for (const auto& [x, y, degrees] : kBeforeAndBehind)
    tags.push_back(
        {.id = 84 + static_cast<int>(tags.size()),
         .size = 0.30,
         .T_world_tag = Eigen::Translation3d(x, y, 0) *
                        Isometry3d(AngleAxisd(degrees * kInDegrees, Vector3d::UnitZ()))});
  return tags;
}

StereoLabOptions defaultStereoLab() {
  StereoLabOptions options;
  options.rig = defaultLabRig();
  options.room.tags = defaultRoomTags();
  options.room.walls = {kWallX, kWallY};
  options.head = walkingHead();
  return options;
}

TagLayout layoutOf(const std::vector<LabTag>& tags) {
  TagLayout layout;
  for (const LabTag& tag : tags) layout.tags.push_back({tag.id, tag.size, tag.T_world_tag});
  return layout;
}

}  // namespace slamscope::tracking
