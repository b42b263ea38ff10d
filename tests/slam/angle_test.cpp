// SPDX-License-Identifier: MIT
#include "slam/angle.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace slamscope::slam {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Angle, StaysInHalfOpenInterval) {
  EXPECT_DOUBLE_EQ(wrapAngle(kPi), kPi);
  EXPECT_DOUBLE_EQ(wrapAngle(-kPi), kPi);
  EXPECT_DOUBLE_EQ(wrapAngle(3.0 * kPi), kPi);
  EXPECT_EQ(wrapAngle(0.0), 0.0);
  EXPECT_EQ(wrapAngle(-3.0), -3.0);
  for (int k = -1000; k <= 1000; ++k) {
    const double wrapped = wrapAngle(0.1 * k);
    EXPECT_GT(wrapped, -kPi);
    EXPECT_LE(wrapped, kPi);
  }
}

TEST(Angle, WrapsByWholeTurns) {
  for (int turns = -50; turns <= 50; ++turns) {
    EXPECT_NEAR(wrapAngle(1.25 + 2.0 * kPi * turns), 1.25, 1e-13);
  }
  EXPECT_NEAR(wrapAngle(kPi + 0.1), -kPi + 0.1, 1e-15);
}

TEST(Angle, LetsWhatIsNotFiniteThrough) {
  EXPECT_TRUE(std::isnan(wrapAngle(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(std::isnan(wrapAngle(std::numeric_limits<double>::infinity())));
}

}  // namespace
}  // namespace slamscope::slam
