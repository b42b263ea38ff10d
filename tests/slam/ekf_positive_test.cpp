// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "slam/ekf_slam.hpp"
#include "slam/simulation_random.hpp"
#include "tests/slam/laws.hpp"

namespace slamscope::slam {
namespace {

using testing::scaledLeastEigenvalue;

struct LongRun {
  UpdateMode update = UpdateMode::batch;
  Eigen::Vector3d initial_sigma = Eigen::Vector3d::Zero();
  double sensor_sigma = 0.05;
};

/// Least scaled eigenvalue seen over `updates` updates of a robot on a circle among four features.
double leastEigenvalue(const LongRun& run, std::uint64_t updates) {
  EkfOptions options;
  options.update = run.update;
  options.initial_covariance = run.initial_sigma.array().square().matrix().asDiagonal();
  EkfSlam filter(options);
  const Eigen::Matrix2d M = Eigen::Vector2d(0.0009, 0.0036).asDiagonal();
  const Eigen::Matrix2d R = Eigen::Matrix2d::Identity() * run.sensor_sigma * run.sensor_sigma;
  const Eigen::Vector2d features[] = {{1.5, 0.0}, {0.0, 1.8}, {-1.4, 0.2}, {0.3, -1.5}};
  RandomSource random(17);
  Eigen::Vector3d pose = Eigen::Vector3d::Zero();
  double least = 1.0;
  for (int step = 0; filter.counters().updates < updates; ++step) {
    const Eigen::Vector2d velocity(0.3, 0.5);
    pose = movePose(pose, arcIncrement(velocity, 0.1));
    const Motion motion = Motion::fromVelocity(velocity[0] + 0.03 * random.normal(),
                                               velocity[1] + 0.06 * random.normal(), 0.1, M);
    std::vector<Observation> readings;
    for (std::size_t k = 0; k < 4; ++k) {
      if (random.uniform() < 0.3) continue;
      Eigen::Vector2d z = observeFeature(options.sensor, pose, features[k]);
      z += run.sensor_sigma * Eigen::Vector2d(random.normal(), random.normal());
      readings.push_back({k, z, R});
    }
    filter.step(std::chrono::milliseconds(100 * step), motion, readings);
    if (step < 200 || step % 20 == 0) {
      least = std::min(least, scaledLeastEigenvalue(filter.snapshot().covariance.dense()));
    }
  }
  return least;
}

TEST(EkfPositive, CovarianceStaysSemiDefiniteOverAHundredThousandUpdates) {
  EXPECT_GE(leastEigenvalue({.update = UpdateMode::sequential}, 100'000), -1e-12);
  EXPECT_GE(leastEigenvalue({.update = UpdateMode::batch}, 100'000), -1e-12);
}

TEST(EkfPositive, AlsoFromALooseStartAndWithASharpSensor) {
  const Eigen::Vector3d loose(10.0, 10.0, 0.5);
  EXPECT_GE(leastEigenvalue({UpdateMode::sequential, loose, 0.05}, 20'000), -1e-12);
  EXPECT_GE(leastEigenvalue({UpdateMode::batch, loose, 0.05}, 20'000), -1e-12);
  EXPECT_GE(leastEigenvalue({UpdateMode::sequential, {0.0, 0.0, 0.0}, 1e-3}, 20'000), -1e-12);
  EXPECT_GE(leastEigenvalue({UpdateMode::batch, {0.0, 0.0, 0.0}, 1e-3}, 20'000), -1e-12);
}

TEST(EkfPositive, TheMeasureSeesAnIndefiniteMatrix) {
  Eigen::Matrix2d P;
  P << 1e-8, 1.0001e-4, 1.0001e-4, 1.0;  // correlation just above one
  EXPECT_LT(scaledLeastEigenvalue(P), -1e-5);
  P << 0.0, 1e-9, 1e-9, 1.0;  // tied to what has no variance
  EXPECT_LT(scaledLeastEigenvalue(P), -1e-5);
  P << 0.0, 0.0, 0.0, 1.0;
  EXPECT_GE(scaledLeastEigenvalue(P), 0.0);
}

}  // namespace
}  // namespace slamscope::slam
