// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "tracking/camera_model.hpp"
#include "tracking/tag_pose.hpp"

namespace slamscope::tracking {

/// One corner of one tag as seen once.
struct CornerSight {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< m, world frame; map frame where `on_map`
  bool on_map = false;  ///< carried by the robot, which stands at the map's origin
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
  double sigma_px = 0.05;  ///< per axis
  int tag = 0;             ///< id
};

using Matrix9d = Eigen::Matrix<double, 9, 9>;

/// Where camera and map are: T_camera_map = T_camera_world · T_world_map.
struct ScenePose {
  Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_world_map = Eigen::Isometry3d::Identity();  ///< in the floor: x, y, yaw
};

/// What is known and what is sought.
struct SceneProblem {
  std::vector<CornerSight> corners;
  bool solve_camera = true;  ///< its six degrees of freedom
  bool solve_map = false;    ///< its three
  /// Measured beforehand, with its information (inverse covariance) of the right perturbation.
  std::optional<Eigen::Isometry3d> prior_T_camera_world;
  Matrix6d prior_information = Matrix6d::Zero();
  double gate_sigmas = 6;
  bool robust = true;  ///< false: every corner counts fully (one tag alone can't spare any)
};

struct SceneFit {
  ScenePose pose;
  /// Of the right perturbations: camera (translation, rotation; world axes), then map (x, y, yaw;
  /// map axes). Zero for what wasn't solved for. Inflated where residuals are beyond what sigmas
  /// say.
  Matrix9d covariance = Matrix9d::Zero();
  double residual_px = 0;  ///< RMS distance, outliers apart
  std::vector<bool> used;  ///< of corners: false for outliers
  int used_count = 0;
};

/// Least squares over all corners (Gauss–Newton with Levenberg's damping). Corners further off than
/// 4 scaled sigma lose weight; at the end those beyond the gate are left out. Nothing where a
/// corner lies outside of the camera's valid set all along, or too few remain.
[[nodiscard]] std::optional<SceneFit> fitScene(const CameraModel& camera,
                                               const SceneProblem& problem, const ScenePose& start);

/// How badly a pose fits, outliers or not: mean over all corners of log(1 + (distance / 0.5 px)²).
/// Compares poses that outliers have pulled to different degrees; a sum of squares would prefer the
/// one that was pulled most.
[[nodiscard]] double sceneMisfit(const CameraModel& camera, const std::vector<CornerSight>& corners,
                                 const ScenePose& pose);

/// Distances of corners to their projections, over sigma (infinite where out of view).
[[nodiscard]] std::vector<double> sceneDistances(const CameraModel& camera,
                                                 const std::vector<CornerSight>& corners,
                                                 const ScenePose& pose);

/// [v]× with [v]× w = v × w.
[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// How the right perturbations of SceneFit::covariance move T_camera_map (right perturbation, map
/// axes).
[[nodiscard]] Eigen::Matrix<double, 6, 9> mapPerturbation(const Eigen::Isometry3d& T_world_map);

}  // namespace slamscope::tracking
