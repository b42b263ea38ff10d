// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <random>

#include "tracking/camera_model.hpp"
#include "tracking/tag_detector.hpp"
#include "tracking/tag_layout.hpp"

namespace slamscope::tracking::testing {

/// The specification's overhead camera: f = 1000 px, a picture that holds 3 m × 3 m from 3 m up.
inline CameraInfo overheadCamera() {
  CameraInfo info;
  info.width = info.height = 1100;
  info.K << 1000, 0, 549.5, 0, 1000, 549.5, 0, 0, 1;
  return info;
}

/// 3 m up, looking straight down, x of the world to the right in the picture.
inline Eigen::Isometry3d lookingDown(double height = 3) {
  Eigen::Isometry3d T_world_camera(Eigen::Translation3d(0, 0, height));
  T_world_camera.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  return T_world_camera.inverse();
}

/// What a detector with Gaussian corner noise of `sigma_px` per axis makes of a tag in view.
inline TagDetection seeTag(const CameraModel& camera, const Eigen::Isometry3d& T_camera_tag, int id,
                           double size_m, double sigma_px, std::mt19937& random) {
  std::normal_distribution<double> noise(0, 1);
  TagDetection tag;
  tag.id = id;
  tag.margin = 100;
  tag.refined = true;
  const auto p_tag = tagCorners(size_m);
  for (std::size_t i = 0; i < 4; ++i) {
    tag.corners_px[i] = camera.project(T_camera_tag * p_tag[i]).value();
    tag.corners_px[i] += sigma_px * Eigen::Vector2d(noise(random), noise(random));
    tag.sigma_px[i] = sigma_px;
  }
  return tag;
}

inline std::vector<TagDetection> seeLayout(const CameraModel& camera, const TagLayout& layout,
                                           const Eigen::Isometry3d& T_camera_world, double sigma_px,
                                           std::mt19937& random) {
  std::vector<TagDetection> tags;
  for (const MappedTag& tag : layout.tags) {
    tags.push_back(
        seeTag(camera, T_camera_world * tag.T_world_tag, tag.id, tag.size_m, sigma_px, random));
  }
  return tags;
}

inline TagLayout floorTags(int count) {
  const double places[8][2] = {{-1, -1},  {1, -1},  {1, 1},   {-1, 1},
                               {0, -1.2}, {1.2, 0}, {0, 1.2}, {-1.2, 0}};
  TagLayout layout;
  for (int i = 0; i < count; ++i) {
    layout.tags.push_back(
        {100 + i, 0.2, Eigen::Isometry3d(Eigen::Translation3d(places[i][0], places[i][1], 0))});
  }
  return layout;
}

/// eᵀ P⁻¹ e, the normalised estimation error squared. (Of any size in one piece of code: Eigen's
/// solvers of fixed size each cost seconds to compile.)
inline double nees(const Eigen::VectorXd& e, const Eigen::MatrixXd& P) {
  return e.dot(P.llt().solve(e));
}

/// Coordinates of the right perturbation (translation first) that takes `from` to `to`.
inline Eigen::Matrix<double, 6, 1> perturbation(const Eigen::Isometry3d& from,
                                                const Eigen::Isometry3d& to) {
  const Eigen::Isometry3d step = from.inverse() * to;
  const Eigen::AngleAxisd turn(step.linear());
  Eigen::Matrix<double, 6, 1> d;
  d << step.translation(), turn.angle() * turn.axis();
  return d;
}

/// 95 % band of the mean of `runs` χ² values with `dof` degrees of freedom (Gaussian
/// approximation).
struct Band {
  double low, high;
  [[nodiscard]] bool holds(double mean) const { return mean > low && mean < high; }
};
inline Band neesBand(int dof, int runs) {
  const double half = 1.96 * std::sqrt(2.0 * dof / runs);
  return {dof - half, dof + half};
}

}  // namespace slamscope::tracking::testing
