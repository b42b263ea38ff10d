// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "tracking/camera_model.hpp"
#include "tracking/tag_detector.hpp"
#include "tracking/tag_layout.hpp"

namespace slamscope::tracking {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

struct TagPoseOptions {
  /// Where the camera is believed to be (the frame before, a sensor). Decides between the two poses
  /// that fit a single tag, and is one more start; it does not pull the result.
  std::optional<Eigen::Isometry3d> prior_T_camera_world = std::nullopt;
  /// A corner further off than this many sigma (and a pixel) is an outlier; its tag is named when
  /// at least two of its corners are.
  double gate_sigmas = 6;
  /// Above it the second pose is too good to tell: ambiguous. Error of the better over that of the
  /// other, for one tag; n tags count n times (ratio to the power n).
  double max_error_ratio = 0.2;
};

/// Pose of the camera from tags of known place, all corners at once.
struct TagPose {
  Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();
  /// Of the right perturbation, translation (m) first: T = T_camera_world · Exp([ρ; φ]), both in
  /// world axes. (Σ JᵀR⁻¹J)⁻¹ with R from TagDetection::sigma_px.
  Matrix6d covariance = Matrix6d::Zero();
  double residual_px =
      0;  ///< RMS distance of a corner from where the pose projects it, outliers apart
  int tags = 0, corners = 0;  ///< used, outliers apart
  std::vector<int>
      rejected_ids;  ///< tags that don't fit the rest: moved, doubled, wrong size, half hidden
  /// Two poses fit and nothing decides. `other` holds the second one whenever there is one.
  bool ambiguous = false;
  double error_ratio = 0;  ///< residual of this over that of the other pose; 0: no other
  std::optional<Eigen::Isometry3d> other;
};

/// Nothing where no mapped tag is in view, or none fits. Starts from each tag's two planar poses,
/// all corners together and the prior; refines the best by robust least squares.
[[nodiscard]] std::optional<TagPose> estimateTagPose(const CameraModel& camera,
                                                     const TagLayout& layout,
                                                     std::span<const TagDetection> detections,
                                                     const TagPoseOptions& options = {});

}  // namespace slamscope::tracking
