// SPDX-License-Identifier: MIT
#include "slam/monte_carlo.hpp"

#include <gtest/gtest.h>

namespace slamscope::slam {
namespace {

MonteCarloOptions smallOptions() {
  MonteCarloOptions options;
  options.runs = 24;
  options.simulation.features = 6;
  options.simulation.loops = 1;
  // Small errors, so that the linearisation does not show.
  options.simulation.initial_sigma = {0.005, 0.005, 0.002};
  options.simulation.sensor_sigma = Eigen::Vector2d(0.01, 0.005);
  options.simulation.odometry_sigma = {0.01, 0.02};
  return options;
}

TEST(MonteCarlo, ACorrectFilterIsConsistent) {
  const MonteCarloResult result = runMonteCarlo(smallOptions());
  EXPECT_TRUE(result.pose.inside()) << result.pose.mean;
  EXPECT_TRUE(result.features.inside()) << result.features.mean;
  EXPECT_NEAR(result.nis.mean, 1.0, 0.03);
  EXPECT_GT(result.nis_inside, 0.9);
  EXPECT_TRUE(result.broken_seeds.empty());
}

TEST(MonteCarlo, AStartThatIsExactlyKnownIsNoHarm) {
  MonteCarloOptions options = smallOptions();
  options.simulation.initial_sigma.setZero();
  const MonteCarloResult result = runMonteCarlo(options);
  EXPECT_TRUE(result.broken_seeds.empty());
  EXPECT_LT(result.pose.mean, 2.0);
  EXPECT_EQ(result.steps.front().pose.dof, 0.0);
  EXPECT_TRUE(result.steps.front().pose.inside());
}

TEST(MonteCarlo, NoiseNineTimesTooLargeIsSeenInTheInnovations) {
  MonteCarloOptions options = smallOptions();
  options.simulation.fault = "noise-9x";
  const MonteCarloResult result = runMonteCarlo(options);
  EXPECT_FALSE(result.nis.inside());
  EXPECT_LT(result.nis.mean, 0.5);
  EXPECT_LT(result.nis_inside, 0.2);
}

TEST(MonteCarlo, AnIndefiniteCovarianceIsCountedNotThrown) {
  MonteCarloOptions options = smallOptions();
  options.simulation.fault = "cross-not-updated";
  EXPECT_FALSE(runMonteCarlo(options).broken_seeds.empty());
}

TEST(MonteCarlo, TheResultDoesNotDependOnThreads) {
  MonteCarloOptions options = smallOptions();
  options.runs = 4;
  options.threads = 1;
  const MonteCarloResult one = runMonteCarlo(options);
  options.threads = 3;
  int calls = 0;
  options.progress = [&](int done) { EXPECT_EQ(done, ++calls); };
  const MonteCarloResult three = runMonteCarlo(options);
  EXPECT_EQ(calls, 4);
  EXPECT_EQ(one.pose.mean, three.pose.mean);
  EXPECT_EQ(one.nis.mean, three.nis.mean);
  ASSERT_EQ(one.steps.size(), three.steps.size());
  EXPECT_EQ(one.steps.back().features.mean, three.steps.back().features.mean);
}

TEST(MonteCarlo, OptionsOutOfRangeAreRefused) {
  MonteCarloOptions options = smallOptions();
  options.runs = 0;
  EXPECT_THROW(static_cast<void>(runMonteCarlo(options)), std::invalid_argument);
  options = smallOptions();
  options.simulation.fault = "nonesuch";
  EXPECT_THROW(static_cast<void>(runMonteCarlo(options)), std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::slam
