// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace slamscope::tracking {

/// One corner of a tag in a picture, lens and K taken off.
struct BundleCorner {
  std::size_t picture = 0, tag = 0;                 ///< indices
  Eigen::Vector3d p_tag = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();     ///< in the plane z = 1
  /// From that plane to sigmas: the lens's derivative there, px, over the corner's sigma.
  Eigen::Matrix2d to_sigmas = Eigen::Matrix2d::Identity();
};

/// Poses of pictures and tags, and what holds them.
struct Bundle {
  std::vector<Eigen::Isometry3d> T_camera_world;  ///< by picture
  std::vector<Eigen::Isometry3d> T_world_tag;     ///< by tag
  std::vector<BundleCorner> corners;
  std::size_t gauge = 0;  ///< the tag that stays where it is; with `floor`: only its x, y and yaw
  /// Tags that lie on z = 0, with half their side (m).
  struct OnFloor {
    std::size_t tag;
    double half;
  };
  std::vector<OnFloor> floor;
  double floor_sigma = 5e-4;  ///< how flat it is, m
};

/// Least squares over all corners, Cauchy's loss beyond `full_weight` sigmas (Ceres). Throws
/// std::runtime_error where it comes to no end.
void adjust(Bundle& bundle, double full_weight);

/// Distance of each corner to its projection, in sigmas; infinite behind a camera.
[[nodiscard]] std::vector<double> bundleDistances(const Bundle& bundle);

}  // namespace slamscope::tracking
