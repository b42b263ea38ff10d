// SPDX-License-Identifier: MIT
#include "apps/lib/view/broken_snapshot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "slam/simulation.hpp"

namespace slamscope::apps {
namespace {

slam::Snapshot sound() {
  slam::Simulation simulation({.loops = 0});
  while (simulation.step()) {
  }
  return simulation.filter().snapshot();
}

TEST(BrokenSnapshot, SoundOneIsNotBroken) {
  EXPECT_EQ(brokenness(sound()), std::nullopt);
}

TEST(BrokenSnapshot, ExactlyKnownStartPoseIsNotBroken) {
  slam::Snapshot snapshot;
  snapshot.covariance = slam::PackedCovariance(3);
  EXPECT_EQ(brokenness(snapshot), std::nullopt);
}

TEST(BrokenSnapshot, NamesWhatADivergingFilterWrites) {
  slam::Snapshot snapshot = sound();
  snapshot.pose.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(brokenness(snapshot), "a number is not finite");

  snapshot = sound();
  snapshot.pose.x() = 2e6;
  EXPECT_EQ(brokenness(snapshot), "the pose is beyond 1e6 m");

  snapshot = sound();
  snapshot.covariance(3, 3) = -1e-3;
  EXPECT_EQ(brokenness(snapshot), "variance 3 is negative");

  snapshot = sound();
  snapshot.asymmetry = 0.5;
  EXPECT_EQ(brokenness(snapshot), "the covariance is asymmetric");

  snapshot = sound();
  snapshot.covariance(4, 3) =
      2.0 * std::sqrt(snapshot.covariance(3, 3) * snapshot.covariance(4, 4));
  EXPECT_EQ(brokenness(snapshot), "the covariance is indefinite");
}

}  // namespace
}  // namespace slamscope::apps
