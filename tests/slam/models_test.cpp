// SPDX-License-Identifier: MIT
#include "slam/models.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "slam/angle.hpp"
#include "slam/simulation_random.hpp"
#include "tests/slam/central_differences.hpp"

namespace slamscope::slam {
namespace {

using testing::centralDifferences;
using testing::kTolerance;
using testing::relativeDifference;

constexpr double kHalfTurn = std::numbers::pi;
constexpr Sensor kSensors[] = {Sensor::range_bearing, Sensor::relative_position};

Eigen::VectorXd minusPose(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd difference = a - b;
  difference[2] = wrapAngle(difference[2]);
  return difference;
}

Eigen::VectorXd minus(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a - b;
}

/// Identity, tiny and random arguments of `size` numbers within ±`span`.
std::vector<Eigen::VectorXd> arguments(int size, double span) {
  std::vector<Eigen::VectorXd> result{Eigen::VectorXd::Zero(size),
                                      Eigen::VectorXd::Constant(size, 1e-9),
                                      Eigen::VectorXd::Constant(size, -1e-4)};
  RandomSource random(7);
  for (int k = 0; k < 50; ++k) {
    Eigen::VectorXd x(size);
    for (double& value : x) value = random.uniform(-span, span);
    result.push_back(x);
  }
  return result;
}

/// The exact arc by a thousand small straight steps, as Richardson would refine them.
Eigen::Vector3d integrate(double forward, double turn, double duration) {
  Eigen::Vector3d pose = Eigen::Vector3d::Zero();
  constexpr int kSteps = 100000;
  const double dt = duration / kSteps;
  for (int k = 0; k < kSteps; ++k) {
    const double middle = pose[2] + 0.5 * turn * dt;
    pose += Eigen::Vector3d(forward * std::cos(middle), forward * std::sin(middle), turn) * dt;
  }
  return pose;
}

TEST(Motion, ArcAgreesWithFineIntegration) {
  for (const double turn : {0.0, 1e-9, 0.0099, 0.0101, -0.7, 3.0}) {
    const Eigen::Vector3d arc = arcIncrement({0.8, turn}, 1.0);
    EXPECT_LT((arc - integrate(0.8, turn, 1.0)).norm(), 1e-9) << turn;
  }
  // Must fail: a straight step along the heading at the end is no arc.
  EXPECT_GT(
      (Eigen::Vector3d(0.8 * std::cos(0.7), 0.8 * std::sin(0.7), 0.7) - integrate(0.8, 0.7, 1.0))
          .norm(),
      1e-3);
}

TEST(Motion, HalfTurnEndsOnADiameter) {
  const Eigen::Vector3d arc = arcIncrement({kHalfTurn, kHalfTurn}, 1.0);
  EXPECT_NEAR(arc[0], 0.0, 1e-15);
  EXPECT_NEAR(arc[1], 2.0, 1e-15);
}

TEST(Motion, ArcJacobianIsTheDerivative) {
  for (const Eigen::VectorXd& velocity : arguments(2, 3.0)) {
    Matrix32d G_u;
    EXPECT_TRUE(arcIncrement(velocity, 0.5, &G_u).allFinite());
    const Eigen::MatrixXd numeric = centralDifferences(
        [](const Eigen::VectorXd& u) -> Eigen::VectorXd { return arcIncrement(u, 0.5); }, velocity,
        minus);
    EXPECT_LT(relativeDifference(G_u, numeric), kTolerance) << velocity.transpose();
    G_u(2, 1) = -G_u(2, 1);
    EXPECT_GT(relativeDifference(G_u, numeric), kTolerance) << "sign flipped";
  }
}

TEST(Motion, PoseJacobiansAreTheDerivatives) {
  for (const Eigen::VectorXd& argument : arguments(6, 3.0)) {
    Eigen::Matrix3d F_x;
    Eigen::Matrix3d G_u;
    movePose(argument.head<3>(), argument.tail<3>(), &F_x, &G_u);
    const Eigen::MatrixXd numeric = centralDifferences(
        [](const Eigen::VectorXd& a) -> Eigen::VectorXd {
          return movePose(a.head<3>(), a.tail<3>());
        },
        argument, minusPose);
    Eigen::MatrixXd analytic(3, 6);
    analytic << F_x, G_u;
    EXPECT_LT(relativeDifference(analytic, numeric), kTolerance) << argument.transpose();
    analytic(1, 4) = -analytic(1, 4) + 1e-5;
    EXPECT_GT(relativeDifference(analytic, numeric), kTolerance) << "sign flipped";
  }
}

TEST(Motion, IncrementBetweenInvertsMove) {
  for (const Eigen::VectorXd& argument : arguments(6, 3.0)) {
    const Eigen::Vector3d to = movePose(argument.head<3>(), argument.tail<3>());
    const Eigen::Vector3d increment = incrementBetween(argument.head<3>(), to);
    EXPECT_LT(minusPose(increment, argument.tail<3>()).norm(), 1e-13);
  }
}

TEST(Motion, ControlNoiseIsMappedByTheJacobian) {
  const Eigen::Matrix2d M = Eigen::Vector2d(0.04, 0.09).asDiagonal();
  const Motion straight = Motion::fromVelocity(1.0, 0.0, 0.5, M);
  // Along: σ² t². Heading: σ_ω² t². Across: half the heading's error times the way, and tied to it.
  EXPECT_NEAR(straight.M(0, 0), 0.04 * 0.25, 1e-15);
  EXPECT_NEAR(straight.M(2, 2), 0.09 * 0.25, 1e-15);
  EXPECT_NEAR(straight.M(1, 2), 0.09 * 0.25 * 0.25, 1e-15);
  EXPECT_NEAR(straight.M(1, 1), 0.09 * 0.25 * 0.0625, 1e-15);
  EXPECT_EQ(straight.control, Eigen::Vector2d(1.0, 0.0));
}

TEST(Observation, ReadsRangeAndBearing) {
  const Eigen::Vector3d pose(1.0, 2.0, kHalfTurn / 2.0);
  const Eigen::Vector2d z = observeFeature(Sensor::range_bearing, pose, {1.0, 5.0});
  EXPECT_NEAR(z[0], 3.0, 1e-15);
  EXPECT_NEAR(z[1], 0.0, 1e-15);
  const Eigen::Vector2d left = observeFeature(Sensor::relative_position, pose, {-1.0, 3.0});
  EXPECT_NEAR(left[0], 1.0, 1e-15);
  EXPECT_NEAR(left[1], 2.0, 1e-15);
}

TEST(Observation, JacobiansAreTheDerivatives) {
  for (const Sensor sensor : kSensors) {
    for (const Eigen::VectorXd& argument : arguments(5, 3.0)) {
      Eigen::VectorXd x = argument;
      if ((x.tail<2>() - x.head<2>()).norm() < 0.2) x[3] += 1.0;  // no bearing at no distance
      const auto [H_v, H_f] = observeJacobians(sensor, x.head<3>(), x.tail<2>());
      const Eigen::MatrixXd numeric = centralDifferences(
          [sensor](const Eigen::VectorXd& a) -> Eigen::VectorXd {
            return observeFeature(sensor, a.head<3>(), a.tail<2>());
          },
          x,
          [sensor](const Eigen::VectorXd& a, const Eigen::VectorXd& b) -> Eigen::VectorXd {
            return observationDifference(sensor, a, b);
          });
      Eigen::MatrixXd analytic(2, 5);
      analytic << H_v, H_f;
      EXPECT_LT(relativeDifference(analytic, numeric), kTolerance) << x.transpose();
      analytic.col(2) = -analytic.col(2);
      EXPECT_GT(relativeDifference(analytic, numeric), kTolerance) << "sign flipped";
    }
  }
}

TEST(Observation, InverseModelJacobiansAreTheDerivatives) {
  for (const Sensor sensor : kSensors) {
    for (const Eigen::VectorXd& argument : arguments(5, 3.0)) {
      Eigen::VectorXd x = argument;
      x[3] += 4.0;
      Matrix23d G_v;
      Eigen::Matrix2d G_z;
      locateFeature(sensor, x.head<3>(), x.tail<2>(), &G_v, &G_z);
      const Eigen::MatrixXd numeric = centralDifferences(
          [sensor](const Eigen::VectorXd& a) -> Eigen::VectorXd {
            return locateFeature(sensor, a.head<3>(), a.tail<2>());
          },
          x, minus);
      Eigen::MatrixXd analytic(2, 5);
      analytic << G_v, G_z;
      EXPECT_LT(relativeDifference(analytic, numeric), kTolerance) << x.transpose();
      analytic.col(2) = -analytic.col(2);
      EXPECT_GT(relativeDifference(analytic, numeric), kTolerance) << "sign flipped";
    }
  }
}

TEST(Observation, InverseModelInverts) {
  for (const Sensor sensor : kSensors) {
    for (const Eigen::VectorXd& argument : arguments(5, 3.0)) {
      const Eigen::Vector2d feature = argument.tail<2>() + Eigen::Vector2d(0.5, 0.0);
      const Eigen::Vector2d z = observeFeature(sensor, argument.head<3>(), feature);
      EXPECT_LT((locateFeature(sensor, argument.head<3>(), z) - feature).norm(), 1e-13);
    }
  }
}

TEST(Observation, DifferenceOfBearingsWraps) {
  const Eigen::Vector2d d = observationDifference(Sensor::range_bearing, {2.0, 3.1}, {1.5, -3.1});
  EXPECT_NEAR(d[0], 0.5, 1e-15);
  EXPECT_NEAR(d[1], 6.2 - 2.0 * kHalfTurn, 1e-14);
  const Eigen::Vector2d metres =
      observationDifference(Sensor::relative_position, {2.0, 3.1}, {1.5, -3.1});
  EXPECT_NEAR(metres[1], 6.2, 1e-15);
}

TEST(Observation, UnknownSensorIsRefused) {
  const Eigen::Vector3d pose = Eigen::Vector3d::Zero();
  EXPECT_THROW(static_cast<void>(observeFeature(Sensor::unknown, pose, {1.0, 0.0})),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(observeJacobians(Sensor::unknown, pose, {1.0, 0.0})),
               std::invalid_argument);
  EXPECT_THROW(locateFeature(Sensor::unknown, Eigen::Vector3d::Zero(), {1.0, 0.0}),
               std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::slam
