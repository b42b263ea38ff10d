// SPDX-License-Identifier: MIT
#include "slam/reading_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "slam/simulation_random.hpp"

namespace slamscope::slam {
namespace {

const Eigen::Matrix2d kUnsure = Eigen::Vector2d(0.04, 0.01).asDiagonal();

TEST(ReadingError, WhiteErrorIsTheNormalDensityAndLeavesRAlone) {
  const ReadingError white({.memory = 0.0, .slow_memory = 0.0});
  const Eigen::Matrix2d R = white.covariance(2.0);
  EXPECT_NEAR(R(0, 0), 0.2 * 0.2, 1e-12);
  const Eigen::Vector2d innovation(0.1, -0.05);
  EXPECT_EQ(white.logLikelihood({innovation, kUnsure, R, 5.0, 0.0}),
            logNormal(innovation, kUnsure + R));
  EXPECT_EQ(white.correctionCovariance(R, 0.0), R);
}

TEST(ReadingError, LogNormalIsADensity) {
  double sum = 0.0;
  for (int i = -200; i <= 200; ++i) {
    for (int j = -200; j <= 200; ++j) {
      sum += std::exp(logNormal({0.01 * i, 0.005 * j}, kUnsure)) * 0.01 * 0.005;
    }
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);
  EXPECT_EQ(logNormal({0, 0}, -kUnsure), -std::numeric_limits<double>::infinity());
}

/// The oracle: an error that follows the model, with a map that is certain. The likelihood under
/// the true memory must beat those under others on average; a wrong one must be found out.
TEST(ReadingError, TheTrueMemoryExplainsErrorsBest) {
  const double interval = 0.5;
  const auto meanLogLikelihood = [&](double true_memory, double assumed) {
    RandomSource random(5);
    const ReadingError error({.memory = assumed, .jump_share = 0.0});
    const Eigen::Matrix2d R = error.covariance(2.0);
    const double g = std::exp(-interval / true_memory);
    double range_error = 0.2 * random.normal();
    double sum = 0.0;
    for (int k = 0; k < 4000; ++k) {
      const double last = range_error;
      range_error = g * range_error + std::sqrt(1 - g * g) * 0.2 * random.normal();
      sum += error.logLikelihood(
          {{range_error, 0.02 * random.normal()}, Eigen::Matrix2d::Zero(), R, last, interval});
    }
    return sum / 4000;
  };
  EXPECT_GT(meanLogLikelihood(3.0, 3.0), meanLogLikelihood(3.0, 0.5) + 0.02);
  EXPECT_GT(meanLogLikelihood(3.0, 3.0), meanLogLikelihood(3.0, 20.0) + 0.02);
  EXPECT_GT(meanLogLikelihood(0.05, 0.05), meanLogLikelihood(0.05, 3.0) + 0.02);
}

/// A hundred readings within 10 s must not make a feature sure of a range that is off all the time.
TEST(ReadingError, CorrelatedReadingsCorrectAsMuchAsTheirMeanIsWorth) {
  const ReadingError error({.memory = 3.0, .slow_memory = 10.0});
  const Eigen::Matrix2d R = error.covariance(2.0);
  const double interval = 0.1;
  const int count = 5000;
  double information = 0.0;
  for (int k = 0; k < count; ++k)
    information += 1.0 / error.correctionCovariance(R, interval)(0, 0);
  const double g = std::exp(-interval / 10.0);
  double variance = 0.0;  // of the mean of so many with correlation g^|i − j|
  for (int lag = 1 - count; lag < count; ++lag) {
    variance += R(0, 0) * std::pow(g, std::abs(lag)) * (count - std::abs(lag)) / count / count;
  }
  EXPECT_NEAR(1.0 / information / variance, 1.0, 0.05);
  EXPECT_EQ(error.correctionCovariance(R, interval)(1, 1), R(1, 1));
  EXPECT_NEAR(error.correctionCovariance(R, 1000.0)(0, 0), R(0, 0), 1e-12);
  EXPECT_TRUE(std::isfinite(error.correctionCovariance(R, 0.0)(0, 0)));
}

TEST(ReadingError, RefusesWhatIsNoError) {
  EXPECT_THROW(ReadingError({.range_sigma = 0.0}), std::invalid_argument);
  EXPECT_THROW(ReadingError({.memory = -1.0}), std::invalid_argument);
  EXPECT_THROW(ReadingError({.jump_share = 1.5}), std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::slam
