// SPDX-License-Identifier: MIT
#include "slam/world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "slam/models.hpp"

namespace slamscope::slam {
namespace {

constexpr WorldKind kKinds[] = {WorldKind::three_clusters, WorldKind::uniform,
                                WorldKind::one_cluster};

TEST(World, FitsTheCameraAndKeepsOffTheLoop) {
  const LoopDrive drive({.loops = 1});
  for (const WorldKind kind : kKinds) {
    for (const int count : {1, 2, 15, 200}) {
      for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const World world = makeWorld(kind, count, seed);
        ASSERT_EQ(world.features.size(), static_cast<std::size_t>(count));
        ASSERT_EQ(world.ids.size(), static_cast<std::size_t>(count));
        EXPECT_EQ(world.ids.front(), 1U);
        for (const Eigen::Vector2d& feature : world.features) {
          EXPECT_LE((feature - kLoopCentre).cwiseAbs().maxCoeff(), 1.45);
          for (int step = 0; step <= drive.stepCount(); ++step) {
            EXPECT_GT((feature - drive.pose(step).head<2>()).norm(), 0.199);
          }
        }
      }
    }
  }
}

TEST(World, IsTheSameForTheSameSeed) {
  for (const WorldKind kind : kKinds) {
    EXPECT_EQ(makeWorld(kind, 15, 4).features, makeWorld(kind, 15, 4).features);
    EXPECT_NE(makeWorld(kind, 15, 4).features, makeWorld(kind, 15, 5).features);
  }
}

TEST(World, HasNames) {
  for (const WorldKind kind : kKinds) EXPECT_EQ(worldFromName(worldName(kind)), kind);
  EXPECT_THROW((void)worldFromName("square"), std::invalid_argument);
  EXPECT_THROW((void)makeWorld(WorldKind::uniform, 0, 1), std::invalid_argument);
}

TEST(LoopDrive, RestsThenDrivesClosedLoopsOfOneMetre) {
  const LoopDrive drive({.loops = 2});
  EXPECT_EQ(drive.timeOf(10), std::chrono::seconds(1));
  for (int step = 0; step <= 10; ++step) EXPECT_EQ(drive.pose(step), Eigen::Vector3d::Zero());
  Eigen::Array2d low = Eigen::Array2d::Zero();
  Eigen::Array2d high = Eigen::Array2d::Zero();
  for (int step = 0; step <= drive.stepCount(); ++step) {
    low = low.min(drive.pose(step).head<2>().array());
    high = high.max(drive.pose(step).head<2>().array());
  }
  EXPECT_NEAR(low[0], -0.5, 1e-9);
  EXPECT_NEAR(high[0], 0.5, 1e-9);
  EXPECT_NEAR(low[1], 0.0, 1e-9);
  EXPECT_NEAR(high[1], 1.0, 1e-9);
  EXPECT_LT(drive.pose(drive.stepCount()).norm(), 1e-12);
}

TEST(LoopDrive, KeepsAboutItsSpeedAtAnyRate) {
  for (const double rate : {4.0, 10.0, 30.0, 100.0}) {
    const LoopDrive drive({.loops = 1, .rate = rate});
    EXPECT_LT(drive.pose(drive.stepCount()).norm(), 1e-12) << rate;
    for (int step = static_cast<int>(rate); step < drive.stepCount(); ++step) {
      EXPECT_NEAR(drive.velocity(step)[0], 0.25, 0.05) << rate;
    }
  }
}

TEST(LoopDrive, PoseBetweenStepsLiesOnTheArc) {
  const LoopDrive drive({.loops = 1});
  for (int step = 0; step < drive.stepCount(); ++step) {
    const Eigen::Vector3d half = drive.poseAt(drive.timeOf(step) + std::chrono::milliseconds(50));
    const Eigen::Vector3d expected =
        movePose(drive.pose(step), arcIncrement(drive.velocity(step), 0.05));
    EXPECT_LT((half - expected).norm(), 1e-9);
  }
  EXPECT_EQ(drive.poseAt(std::chrono::seconds(-1)), drive.pose(0));
  EXPECT_EQ(drive.poseAt(std::chrono::hours(1)), drive.pose(drive.stepCount()));
}

TEST(LoopDrive, RefusesNonsense) {
  EXPECT_THROW(LoopDrive({.loops = -1}), std::invalid_argument);
  EXPECT_THROW(LoopDrive({.rate = 0.0}), std::invalid_argument);
  EXPECT_THROW(LoopDrive({.speed = -1.0}), std::invalid_argument);
  EXPECT_THROW(LoopDrive({.rest = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::slam
