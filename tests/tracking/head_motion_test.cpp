// SPDX-License-Identifier: MIT
#include "tracking/head_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "tests/tracking/seen_room.hpp"
#include "tracking/head_overlay.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds, std::chrono::nanoseconds;
using Vector18d = Eigen::Matrix<double, 18, 1>;

HeadMotion anyMotion(double scale) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, scale);
  const auto some = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  HeadMotion motion;
  motion.T_world_head.translation() = some();
  motion.T_world_head.linear() = rotationExp(some());
  motion.v_world = some();
  motion.omega_head = some();
  motion.alpha_head = some();
  motion.jerk_head = some();
  return motion;
}

HeadMotion shifted(const HeadMotion& motion, const Vector18d& errors) {
  HeadMotion result = corrected(motion, errors.head<12>());
  result.alpha_head += errors.segment<3>(12);
  result.jerk_head += errors.tail<3>();
  return result;
}

Vector18d errorsBetween(const HeadMotion& from, const HeadMotion& to) {
  Vector18d errors;
  errors << difference(from, to), to.alpha_head - from.alpha_head, to.jerk_head - from.jerk_head;
  return errors;
}

Matrix18d numericJacobian(const HeadMotion& motion, double dt) {
  constexpr double kStep = 1e-5;
  const HeadMotion to = moved(motion, dt);
  Matrix18d J;
  for (int i = 0; i < 18; ++i) {
    const Vector18d d = kStep * Vector18d::Unit(i);
    J.col(i) = (errorsBetween(to, moved(shifted(motion, d), dt)) -
                errorsBetween(to, moved(shifted(motion, -d), dt))) /
               (2 * kStep);
  }
  return J;
}

TEST(HeadMotion, JacobianIsThatOfCentralDifferences) {
  for (const double scale : {0.0, 1e-6, 1.0}) {
    for (const double dt : {0.1, -0.02}) {
      const HeadMotion motion = anyMotion(scale);
      Matrix18d J;
      static_cast<void>(moved(motion, dt, &J));
      const Matrix18d numeric = numericJacobian(motion, dt);
      EXPECT_LT((J - numeric).norm(), 1e-7 * numeric.norm()) << scale << " " << dt;
      J.block<3, 3>(3, 12) *= -1;
      EXPECT_GT((J - numeric).norm(), 1e-7 * numeric.norm()) << "a wrong sign must be seen";
    }
  }
}

TEST(HeadMotion, PixelsFollowTheFirstTwelveErrorsAsTheirJacobianSays) {
  testing::SeenRoom room;
  room.rig.cameras[0].readout = milliseconds(20);
  const EyeCamera eye(room.rig, 0);
  HeadMotion motion = anyMotion(0);
  motion.T_world_head = room.head(testing::atFrame(10));
  motion.v_world = {0.4, -0.3, 0.1};
  motion.omega_head = {0.2, 1.9, -0.4};
  motion.alpha_head = {1, -7, 2};
  constexpr double kStep = 1e-6, kDelay = 0.007;
  const Vector3d p(0.3, 0.2, 0.1);
  HeadJacobian J;
  ASSERT_TRUE(projectAt(eye, motion, p, kDelay, &J));
  for (int i = 0; i < 12; ++i) {
    const Vector12d d = kStep * Vector12d::Unit(i);
    const Eigen::Vector2d slope = (*projectAt(eye, corrected(motion, d), p, kDelay) -
                                   *projectAt(eye, corrected(motion, -d), p, kDelay)) /
                                  (2 * kStep);
    EXPECT_LT((slope - J.col(i)).norm(), 1e-5 * (1 + slope.norm())) << i;
    if (i < 6) {
      EXPECT_GT((slope + J.col(i)).norm(), 1e-3) << "a flipped sign must be seen";
    }
  }
}

TEST(HeadMotion, TwoStepsLeaveTheCovarianceOfOne) {
  HeadMotion rest;  // axes don't turn: the noise of both ways is exactly the same
  rest.covariance.setIdentity();
  const HeadMotion once = predicted(rest, milliseconds(100), {});
  const HeadMotion twice = predicted(predicted(rest, milliseconds(30), {}), milliseconds(100), {});
  EXPECT_LT((once.covariance - twice.covariance).norm(), 1e-9 * once.covariance.norm());
  EXPECT_GT((once.covariance - rest.covariance).norm(), 1e-3);
}

/// What is measured of the first twelve numbers, by the ordinary update over all eighteen.
TEST(HeadMotion, WhatIsNotMeasuredFollowsAsInAKalmanUpdate) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  HeadMotion prior = anyMotion(0.1);
  const Matrix18d root = Matrix18d::NullaryExpr([&] { return 0.1 * normal(random); });
  prior.covariance = root * root.transpose() + 0.01 * Matrix18d::Identity();
  Eigen::Matrix<double, 12, 18> H = Eigen::Matrix<double, 12, 18>::Zero();
  H.leftCols<12>().setIdentity();
  const Matrix12d R = 0.02 * Matrix12d::Identity();
  const Vector12d z = Vector12d::NullaryExpr([&] { return 1e-4 * normal(random); });
  const Eigen::Matrix<double, 18, 12> K =
      prior.covariance * H.transpose() * (H * prior.covariance * H.transpose() + R).inverse();
  const Vector18d step = K * z;
  const Matrix18d P = (Matrix18d::Identity() - K * H) * prior.covariance;
  const HeadMotion result =
      conditioned(prior, corrected(prior, step.head<12>()), P.topLeftCorner<12, 12>());
  EXPECT_LT((result.covariance - P).norm(), 1e-9);
  EXPECT_LT((result.alpha_head - prior.alpha_head - step.segment<3>(12)).norm(), 1e-9);
  EXPECT_LT((result.jerk_head - prior.jerk_head - step.tail<3>()).norm(), 1e-9);
  EXPECT_GT(step.tail<6>().norm(), 1e-7) << "something must follow";
}

}  // namespace
}  // namespace slamscope::tracking
