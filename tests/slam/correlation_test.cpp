// SPDX-License-Identifier: MIT
#include "slam/correlation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "slam/simulation_random.hpp"

namespace slamscope::slam {
namespace {

Eigen::MatrixXd randomCovariance(int size, RandomSource& random) {
  Eigen::MatrixXd A(size, size);
  for (double& value : A.reshaped()) value = random.normal();
  return A * A.transpose();
}

TEST(Correlation, RelativeCovarianceIsThatOfTheDifference) {
  RandomSource random(3);
  Snapshot snapshot;
  snapshot.ids = {1, 2, 3};
  snapshot.features.resize(3);
  const Eigen::MatrixXd P = randomCovariance(9, random);
  snapshot.covariance = PackedCovariance::fromLower(P);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2, 9);  // d = f_i − f_j = A x
      A.block<2, 2>(0, 3 + 2 * i) += Eigen::Matrix2d::Identity();
      A.block<2, 2>(0, 3 + 2 * j) -= Eigen::Matrix2d::Identity();
      const Eigen::Matrix2d expected = A * P * A.transpose();
      EXPECT_LT((relativeCovariance(snapshot, i, j) - expected).norm(), 1e-13);
    }
  }
  const Eigen::Matrix2d without_cross = P.block<2, 2>(3, 3) + P.block<2, 2>(5, 5);
  EXPECT_GT((relativeCovariance(snapshot, 0, 1) - without_cross).norm(), 1e-3) << "must fail";
}

TEST(Correlation, IsRefusedWhereOnlyTheDiagonalIsKnown) {
  Snapshot snapshot;
  snapshot.ids = {1, 2};
  snapshot.features.resize(2);
  snapshot.covariance = PackedCovariance(7);
  snapshot.diagonal_only = true;
  EXPECT_THROW((void)relativeCovariance(snapshot, 0, 1), std::invalid_argument);
}

TEST(PrincipalAxes, AgreeWithTheGeneralSolver) {
  RandomSource random(4);
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Matrix2d P = randomCovariance(2, random) * std::pow(10.0, random.uniform(-8, 2));
    const PrincipalAxes axes = principalAxes(P);
    const Eigen::Vector2d reference =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(P).eigenvalues();
    EXPECT_NEAR(axes.eigenvalues[0], reference[1], 1e-13 * reference[1]);
    EXPECT_NEAR(axes.eigenvalues[1], reference[0], 1e-13 * reference[1]);
    const Eigen::Matrix2d V = axes.directions();
    const Eigen::Matrix2d rebuilt = V * axes.eigenvalues.asDiagonal() * V.transpose();
    EXPECT_LT((rebuilt - P).norm(), 1e-13 * P.norm());
    EXPECT_NEAR(V.determinant(), 1.0, 1e-14);
    const Eigen::Matrix2d swapped = V * axes.eigenvalues.reverse().asDiagonal() * V.transpose();
    EXPECT_GT((swapped - P).norm(), 1e-9 * P.norm()) << "must fail";
  }
}

TEST(PrincipalAxes, OfSpecialMatrices) {
  EXPECT_EQ(principalAxes(Eigen::Matrix2d::Zero()).eigenvalues, Eigen::Vector2d(0, 0));
  EXPECT_EQ(principalAxes(Eigen::Matrix2d::Identity()).eigenvalues, Eigen::Vector2d(1, 1));
  const Eigen::Matrix2d upright = Eigen::Vector2d(1.0, 4.0).asDiagonal();
  EXPECT_NEAR(principalAxes(upright).angle, std::numbers::pi / 2.0, 1e-15);
  EXPECT_EQ(principalAxes(upright).eigenvalues, Eigen::Vector2d(4, 1));
}

TEST(PrincipalAxes, OfSingularMatricesHaveNoNegativeEigenvalue) {
  RandomSource random(5);
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Vector2d v(random.normal(), random.normal());
    const PrincipalAxes axes = principalAxes(v * v.transpose());
    EXPECT_GE(axes.eigenvalues[1], 0.0);
    EXPECT_LE(axes.eigenvalues[1], 1e-15 * axes.eigenvalues[0]);
  }
  Eigen::Matrix2d indefinite;
  indefinite << 1.0, 2.0, 2.0, 1.0;
  EXPECT_NEAR(principalAxes(indefinite).eigenvalues[1], -1.0, 1e-15) << "a real one is not hidden";
}

TEST(Correlation, AreaIsRootOfTheDeterminant) {
  const Eigen::Matrix2d P = Eigen::Vector2d(4.0, 9.0).asDiagonal();
  EXPECT_EQ(ellipseArea(P), 6.0);
  EXPECT_EQ(ellipseArea(Eigen::Matrix2d::Ones()), 0.0);
}

TEST(AxisScale, IsWhatItsNameSays) {
  EXPECT_DOUBLE_EQ((AxisScale{Axis::eigenvalue, 3.0, 20.0}.semiAxis(0.01)), 0.2);
  EXPECT_DOUBLE_EQ((AxisScale{Axis::sigma, 3.0, 1.0}.semiAxis(0.01)), 0.3);
  EXPECT_DOUBLE_EQ((AxisScale{Axis::sigma, 2.0, 0.5}.semiAxis(0.01)), 0.1);
  EXPECT_DOUBLE_EQ((AxisScale{Axis::log, 1.0, 1.0}.semiAxis(81e-6)), 0.1);  // 9 mm
  for (const Axis axis : {Axis::eigenvalue, Axis::sigma, Axis::log}) {
    const AxisScale scale{axis, 3.0, 2.0};
    EXPECT_EQ(scale.semiAxis(0.0), 0.0);
    EXPECT_EQ(scale.semiAxis(-1.0), 0.0);
    double last = 0.0;
    for (double eigenvalue = 1e-12; eigenvalue < 1e4; eigenvalue *= 3.0) {
      EXPECT_GT(scale.semiAxis(eigenvalue), last);
      last = scale.semiAxis(eigenvalue);
    }
  }
}

}  // namespace
}  // namespace slamscope::slam
