// SPDX-License-Identifier: MIT
#include <numbers>

#include "tracking/lab.hpp"

namespace slamscope::tracking {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

CameraInfo defaultLabCamera() {
  CameraInfo camera;
  camera.name = "lab_overhead";
  camera.width = 1280;
  camera.height = 720;
  camera.K << 640, 0, 643.2, 0, 640, 356.4, 0, 0, 1;
  camera.D = {-0.12, 0.03, 0.0006, -0.0004, -0.003};
  return camera;
}

Eigen::Isometry3d defaultLabCameraPose() {
  // Straight down is half a turn about x; then as crooked as a ceiling mount is.
  return Eigen::Translation3d(0.035, 0.02, 3.0) *
         Eigen::AngleAxisd(0.8 * kDegree, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(std::numbers::pi + 0.5 * kDegree, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(-0.7 * kDegree, Eigen::Vector3d::UnitY());
}

std::vector<LabTag> defaultFloorTags() {
  // Laid by hand: none quite parallel to another.
  struct Place {
    double x, y, degrees;
  };
  constexpr Place kPlaces[] = {{-2.55, 1.22, 4},   {-1.83, 0.42, -7}, {-1.84, -1.17, 11},
                               {-2.62, -0.75, -3}, {1.86, 1.20, -12}, {2.60, 0.66, 6},
                               {2.52, -1.26, -5},  {1.85, -0.46, 9}};
  std::vector<LabTag> tags;
  for (const Place& place : kPlaces)
    tags.push_back({.id = 100 + static_cast<int>(tags.size()),
                    .size = 0.20,
                    .T_world_tag = Eigen::Translation3d(place.x, place.y, 0) *
                                   Eigen::Isometry3d(Eigen::AngleAxisd(place.degrees * kDegree,
                                                                       Eigen::Vector3d::UnitZ()))});
  return tags;
}

LabOptions defaultLab() {
  LabOptions options;
  options.camera = defaultLabCamera();
  options.T_world_camera = defaultLabCameraPose();
  options.tags = defaultFloorTags();
  return options;
}

}  // namespace slamscope::tracking
