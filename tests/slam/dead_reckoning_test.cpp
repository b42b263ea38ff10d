// SPDX-License-Identifier: MIT
#include "slam/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "slam/angle.hpp"
#include "slam/simulation_random.hpp"
#include "tests/slam/central_differences.hpp"

namespace slamscope::slam {
namespace {

using namespace std::chrono_literals;
using testing::centralDifferences;
using testing::kTolerance;
using testing::relativeDifference;

constexpr AckermannGeometry kTruck{.wheelbase = 2.83, .encoder_left = 0.76};

Eigen::VectorXd reckoningMinus(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd difference = a - b;
  if (a.size() == 3) difference[2] = wrapAngle(difference[2]);
  return difference;
}

TEST(Ackermann, TheMeasuredWheelRunsAtTheMeasuredSpeed) {
  for (const double steering : {-0.5, 0.0, 0.3}) {
    const Eigen::Vector2d velocity = ackermannVelocity(kTruck, {3.0, steering});
    EXPECT_NEAR(velocity[0] - velocity[1] * kTruck.encoder_left, 3.0, 1e-12);
    // The front wheel moves where it points.
    EXPECT_NEAR(std::atan2(velocity[1] * kTruck.wheelbase, velocity[0]), steering, 1e-12);
  }
  EXPECT_EQ(ackermannVelocity(kTruck, {3.0, 0.0}), Eigen::Vector2d(3.0, 0.0));
  EXPECT_THROW(static_cast<void>(ackermannVelocity({}, {1.0, 0.1})), std::invalid_argument);
}

TEST(Ackermann, JacobianIsTheDerivative) {
  RandomSource random(3);
  for (int k = 0; k < 50; ++k) {
    const Eigen::VectorXd control =
        k == 0 ? Eigen::Vector2d(0, 0)
               : Eigen::Vector2d(random.uniform(-3, 5), random.uniform(-0.7, 0.7));
    Eigen::Matrix2d J;
    EXPECT_TRUE(ackermannVelocity(kTruck, control, &J).allFinite());
    const Eigen::MatrixXd numeric = centralDifferences(
        [](const Eigen::VectorXd& u) -> Eigen::VectorXd { return ackermannVelocity(kTruck, u); },
        control, reckoningMinus);
    EXPECT_LT(relativeDifference(J, numeric), kTolerance) << control.transpose();
    J(0, 0) = -J(0, 0);
    EXPECT_GT(relativeDifference(J, numeric), kTolerance) << "sign flipped";
  }
}

/// A drive of one entry a period, and what dead reckoning makes of it up to its end.
Motion driven(Recording::Odometry kind, std::chrono::nanoseconds period,
              const Eigen::Vector3d& sigma) {
  Recording recording;
  recording.odometry_kind = kind;
  recording.vehicle = kTruck;
  const bool car = kind == Recording::Odometry::ackermann;
  for (auto time = 0ns; time <= 4s; time += period) {
    recording.odometry.push_back({time, {2.0, 0.0, car ? 0.2 : 0.15}});
  }
  DeadReckoning reckoning(recording, sigma);
  Motion total;
  for (auto time = 0ns; time < 4s; time += 500ms) {
    total = composed(total, reckoning.between(time, time + 500ms));
  }
  return total;
}

TEST(DeadReckoning, DoesNotDependOnTheRateOfTheOdometry) {
  for (const auto kind : {Recording::Odometry::velocity, Recording::Odometry::ackermann}) {
    const Eigen::Vector3d sigma(0.1, 0.0, 0.05);
    const Motion often = driven(kind, 5ms, sigma);
    const Motion seldom = driven(kind, 100ms, sigma);
    EXPECT_LT((often.increment - seldom.increment).norm(), 1e-9);
    EXPECT_LT((often.M - seldom.M).norm(), 0.05 * often.M.norm())
        << "of the noise only the way it is spread over an entry differs";
    EXPECT_GT(often.M.determinant(), 0.0);
    EXPECT_GT((often.M - 2.0 * seldom.M).norm(), 0.05 * often.M.norm()) << "must fail";
  }
}

/// What noise in each control of a chain of car, arc and pose does to the pose at its end: the
/// composed covariance against that by central differences through the whole chain.
TEST(DeadReckoning, JacobianOfTheWholeCompositionIsTheDerivative) {
  constexpr int kEntries = 6;
  constexpr double kPeriod = 0.4;
  RandomSource random(12);
  Recording recording;
  recording.odometry_kind = Recording::Odometry::ackermann;
  recording.vehicle = kTruck;
  Eigen::VectorXd controls(2 * kEntries);
  for (int k = 0; k <= kEntries; ++k) {
    const Eigen::Vector2d control(random.uniform(1, 4), random.uniform(-0.4, 0.4));
    recording.odometry.push_back({k * 400ms, {control[0], 0.0, control[1]}});
    if (k < kEntries) controls.segment<2>(2 * k) = control;
  }
  const auto chain = [](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    Eigen::Vector3d pose = Eigen::Vector3d::Zero();
    for (int k = 0; k < kEntries; ++k) {
      pose = movePose(pose, arcIncrement(ackermannVelocity(kTruck, u.segment<2>(2 * k)), kPeriod));
    }
    return pose;
  };
  const Eigen::Vector3d sigma(0.2, 0.0, 0.03);
  const Motion motion = DeadReckoning(recording, sigma).between(0ns, kEntries * 400ms);
  EXPECT_LT(reckoningMinus(motion.increment, chain(controls)).norm(), 1e-12);
  const Eigen::MatrixXd J = centralDifferences(chain, controls, reckoningMinus);
  Eigen::VectorXd variance(2 * kEntries);
  for (int k = 0; k < kEntries; ++k) {
    variance.segment<2>(2 * k) << 0.2 * 0.2 / kPeriod, 0.03 * 0.03 / kPeriod;
  }
  const Eigen::MatrixXd numeric = J * variance.asDiagonal() * J.transpose();
  EXPECT_LT((motion.M - numeric).norm(), 1e-6 * numeric.norm());
  EXPECT_GT((motion.M.transpose() - 1.001 * numeric).norm(), 1e-6 * numeric.norm()) << "must fail";
}

TEST(DeadReckoning, CompositionHasTheJacobiansOfMotion) {
  RandomSource random(4);
  for (int k = 0; k < 20; ++k) {
    Eigen::VectorXd both(6);
    for (double& value : both) value = random.uniform(-2, 2);
    const Eigen::Matrix3d A = Eigen::Vector3d(0.1, 0.2, 0.03).asDiagonal();
    const Eigen::Matrix3d B = Eigen::Vector3d(0.4, 0.1, 0.02).asDiagonal();
    const Motion result = composed(Motion::fromIncrement(both.head<3>(), A),
                                   Motion::fromIncrement(both.tail<3>(), B));
    const Eigen::MatrixXd J = centralDifferences(
        [](const Eigen::VectorXd& a) -> Eigen::VectorXd {
          return movePose(a.head<3>(), a.tail<3>());
        },
        both, reckoningMinus);
    const Eigen::MatrixXd expected = J.leftCols<3>() * A * J.leftCols<3>().transpose() +
                                     J.rightCols<3>() * B * J.rightCols<3>().transpose();
    EXPECT_LT(relativeDifference(result.M, expected), 1e-8);
    EXPECT_GT(relativeDifference(result.M, J.leftCols<3>() * A * J.leftCols<3>().transpose()), 1e-8)
        << "must fail: the second one's noise left out";
  }
}

TEST(DeadReckoning, StandsStillWithoutNoiseAndMovesAnywhereWithoutOdometry) {
  Recording standing;
  for (int k = 0; k < 5; ++k) standing.odometry.push_back({k * 1s, Eigen::Vector3d::Zero()});
  EXPECT_TRUE(DeadReckoning(standing, {1, 1, 1}).between(0ns, 4s).M.isZero(0.0));
  const Recording nothing;
  const Motion motion = DeadReckoning(nothing, {1, 2, 3}).between(0ns, 4s);
  EXPECT_EQ(motion.M.diagonal(), Eigen::Vector3d(4, 16, 36));
  EXPECT_TRUE(motion.increment.isZero(0.0));
}

TEST(DeadReckoning, RefusesACarWithoutWheelbase) {
  Recording recording;
  recording.odometry_kind = Recording::Odometry::ackermann;
  EXPECT_THROW(DeadReckoning(recording, {0, 0, 0}), std::invalid_argument);
  recording.vehicle = kTruck;
  EXPECT_THROW(DeadReckoning(recording, {0, -1, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::slam
