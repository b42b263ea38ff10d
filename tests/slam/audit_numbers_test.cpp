// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include "slam/audit/chi_square.hpp"
#include "slam/audit/log_precision.hpp"
#include "slam/audit/scale_test.hpp"
#include "slam/simulation_random.hpp"
#include "tests/slam/audit_runs.hpp"

namespace slamscope::slam {
namespace {

std::vector<double> randomNumbers(int digits) {
  RandomSource random(3);
  std::vector<double> numbers(200);
  for (double& number : numbers) number = rounded(0.01 * random.normal(), digits);
  return numbers;
}

TEST(LogPrecision, IsFoundFromTheNumbers) {
  const auto found = [](int digits) {
    LogPrecision precision;
    precision.take(randomNumbers(digits));
    return precision.name();
  };
  EXPECT_EQ(found(17), "double");
  EXPECT_EQ(found(8), "float32");
  EXPECT_EQ(found(7), "7 digits");
  EXPECT_EQ(found(6), "6 digits");
}

TEST(LogPrecision, KnowsFixedDecimals) {
  std::vector<double> numbers = randomNumbers(17);
  for (double& number : numbers) number = std::round(number * 1e6) / 1e6;
  LogPrecision precision;
  precision.take(numbers);
  EXPECT_EQ(precision.name(), "6 decimals");
  EXPECT_DOUBLE_EQ(precision.absolute(), 0.5e-6);
}

TEST(LogPrecision, OnlyGetsFiner) {
  LogPrecision precision;
  precision.take(std::vector<double>{0.0, 0.04, 0.25});
  EXPECT_EQ(precision.name(), "unknown");  // round numbers, as at a start
  precision.take(randomNumbers(17));
  EXPECT_TRUE(precision.isDouble());
  precision.take(randomNumbers(6));
  EXPECT_TRUE(precision.isDouble());
}

TEST(ChiSquare, MatchesTables) {
  EXPECT_NEAR(chiSquareQuantile(0.05, 1), 3.841459, 1e-6);
  EXPECT_NEAR(chiSquareQuantile(0.01, 2), 9.210340, 1e-6);
  EXPECT_NEAR(chiSquareQuantile(0.001, 3), 16.266236, 1e-6);
  EXPECT_NEAR(chiSquareQuantile(0.95, 100), 77.929465, 1e-5);
  EXPECT_NEAR(chiSquareProbability(2.0, 2), 1.0 - std::exp(-1.0), 1e-14);
}

/// Share of sequences that ever cross log(1/α), of 500 with 300 values of scale `scale`.
double crossings(double scale, double alpha) {
  RandomSource random(11);
  int crossed = 0;
  for (int run = 0; run < 500; ++run) {
    ScaleTest test({0.6, 1.5});
    for (int k = 0; k < 300; ++k) {
      const double a = random.normal();
      const double b = random.normal();
      test.take(scale * (a * a + b * b), 2);
    }
    if (test.evidence() > std::log(2.0 / alpha)) ++crossed;
  }
  return crossed / 500.0;
}

TEST(ScaleTest, RarelyCrossesWithinItsBandHoweverOftenOneLooks) {
  for (const double scale : {0.6, 1.0, 1.5}) EXPECT_LE(crossings(scale, 0.05), 0.08) << scale;
}

TEST(ScaleTest, CrossesOutsideItsBand) {
  EXPECT_GT(crossings(3.0, 1e-6), 0.95);
  EXPECT_GT(crossings(0.3, 1e-6), 0.95);
}

}  // namespace
}  // namespace slamscope::slam
