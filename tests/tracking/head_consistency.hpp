// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>
#include <functional>

#include "tests/tracking/seen_room.hpp"
#include "tests/tracking/seen_tags.hpp"
#include "tracking/head_overlay.hpp"

namespace slamscope::tracking::testing {

/// Mean squared Mahalanobis distances of pose (6 degrees of freedom) and overlay pixel (2) from the
/// truth; `boastful_pose` is the pose's with a covariance a third smaller, which must be seen.
struct HeadConsistency {
  double pose = 0, overlay = 0, boastful_pose = 0;
};

/// Figure T8: heads found from nothing by five tags a picture, `runs` times; `done` after each.
inline HeadConsistency headConsistency(int runs, const std::function<void()>& done = {}) {
  SeenRoom room;
  room.most_tags = 5;
  room.head = standingHead({.sway = 0});
  HeadTrackerOptions options;
  options.corner_bias_px = 0;
  const EyeCamera eye(room.rig, 0);
  const auto time = std::chrono::nanoseconds(0);
  const Eigen::Isometry3d truth = room.head(time);
  const Eigen::Vector3d p(0.3, 0.2, 0);
  const Eigen::Vector2d true_px = room.pixel(0, time, p).value();
  HeadConsistency mean;
  for (int run = 0; run < runs; ++run) {
    HeadTracker tracker(room.rig, room.truth, options);
    tracker.add(room.pair(time));
    const HeadMotion motion = tracker.at(time).value().motion;
    const auto e = perturbation(motion.T_world_head, truth);
    const Eigen::Matrix<double, 6, 6> S = motion.covariance.topLeftCorner<6, 6>();
    mean.pose += nees(e, S) / runs;
    mean.boastful_pose += nees(e, S / 1.5) / runs;
    const Eigen::Vector2d d = projectRolling(eye, motion, p).value() - true_px;
    const Eigen::Matrix2d S_px = overlayCovariance(eye, motion, {}, p).value();
    mean.overlay += nees(d, S_px) / runs;
    if (done) done();
  }
  return mean;
}

}  // namespace slamscope::tracking::testing
