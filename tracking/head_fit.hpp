// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "tracking/head_motion.hpp"
#include "tracking/head_overlay.hpp"

namespace slamscope::tracking {

/// One corner of one tag as one camera saw it.
struct HeadSight {
  std::size_t camera = 0;
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();  ///< where the layout has it, m
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
  double sigma_px = 0.05;  ///< per axis
  double delay = 0;        ///< its row's exposure after the fit's time, s
  int tag = 0;             ///< id
  int square = 0;          ///< counts detections: four sights in a row share it
};

struct HeadFitProblem {
  std::span<const EyeCamera> eyes;
  std::span<const HeadSight> sights;
  /// The head as it is believed to be at the fit's time, with covariance.
  HeadMotion prior;
  /// false: nothing is believed of where it is, only of how it moves.
  bool pose_believed = true;
  double gate_sigmas = 6;
};

struct HeadFit {
  HeadMotion motion;       ///< with covariance, inflated where residuals are beyond what sigmas say
  double residual_px = 0;  ///< RMS distance of used corners
  std::vector<bool> used;  ///< of sights; a square of which two corners don't fit is left out whole
  int used_count = 0;
  /// Squared errors over sigmas (each no more than the gate's) plus those of the prior: half of it
  /// is a negative logarithm of likelihood, so that two fits of the same problem compare.
  double cost = 0;
  /// Change of the pose against the prior, squared Mahalanobis distance, 6 degrees of freedom.
  double surprise = 0;
  bool agrees = false;  ///< every corner is used, and they fit as well as their sigmas say
};

/// All corners of all tags in both pictures and the prior in one least squares over the twelve
/// numbers of HeadMotion (Gauss–Newton with Levenberg's damping: the iterated extended Kalman
/// update). Corners further off than 4 sigma of a scale that narrows from round to round lose
/// weight; at the end those beyond the gate are left out. Nothing where the start sees a corner
/// outside of its camera's valid set, or what remains doesn't determine the pose.
[[nodiscard]] std::optional<HeadFit> fitHead(const HeadFitProblem& problem,
                                             const HeadMotion& start);

/// The same, and where corners contradict each other also from the fits without one tag each: a tag
/// that is off by little pulls the rest along until another one looks wrong. The start counts whose
/// sum of log(1 + (distance / 3 sigma)²) over all corners is least.
[[nodiscard]] std::optional<HeadFit> fitHeadWarily(const HeadFitProblem& problem,
                                                   const HeadMotion& start);

/// Distances of the sights to where a motion projects them, px; infinite out of view.
[[nodiscard]] std::vector<double> headDistances(std::span<const EyeCamera> eyes,
                                                std::span<const HeadSight> sights,
                                                const HeadMotion& motion);

/// How badly a motion fits, outliers or not: mean of log(1 + (distance / 0.5 px)²), as sceneMisfit.
[[nodiscard]] double headMisfit(std::span<const double> distances_px);

}  // namespace slamscope::tracking
