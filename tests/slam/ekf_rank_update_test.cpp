// SPDX-License-Identifier: MIT
#include "slam/ekf_rank_update.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "slam/ekf_cholesky.hpp"
#include "slam/simulation_random.hpp"

namespace slamscope::slam {
namespace {

TEST(RankUpdate, IsTheOuterProductInTheLowerTriangleAndNothingElse) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  RandomSource random(6);
  RankUpdate rank_update;
  for (const int size : {1, 3, 7, 8, 9, 15, 16, 17, 33, 64, 203}) {
    for (const int m : {1, 2, 6, 20}) {
      Eigen::MatrixXd P(size, size);
      Eigen::MatrixXd Y(size, m);
      for (double& value : P.reshaped()) value = random.normal();
      for (double& value : Y.reshaped()) value = random.normal();
      const Eigen::MatrixXd expected = P - Y * Y.transpose();
      P.triangularView<Eigen::StrictlyUpper>().setConstant(kNan);
      rank_update.subtract(P, Y);
      double worst = 0.0;
      double worst_of_twin = 0.0;
      for (int col = 0; col < size; ++col) {
        for (int row = 0; row < size; ++row) {
          if (row < col) {
            EXPECT_TRUE(std::isnan(P(row, col))) << "above the diagonal is not ours";
            continue;
          }
          worst = std::max(worst, std::abs(P(row, col) - expected(row, col)));
          worst_of_twin = std::max(
              worst_of_twin, std::abs(P(row, col) - expected(row, col) - Y(row, 0) * Y(col, 0)));
        }
      }
      EXPECT_LT(worst, 1e-13) << size << " x " << m;
      EXPECT_GT(worst_of_twin, 1e-3) << "must fail: one column left out";
    }
  }
}

TEST(RankUpdate, TwoThreadsGiveTheSameBits) {
  RandomSource random(7);
  constexpr int kSize = 701;
  Eigen::MatrixXd P(kSize, kSize);
  Eigen::MatrixXd Y(kSize, 20);
  for (double& value : P.reshaped()) value = random.normal();
  for (double& value : Y.reshaped()) value = random.normal();
  Eigen::MatrixXd one = P;
  RankUpdate alone;
  alone.setThreads(1);
  alone.subtract(one, Y);
  RankUpdate both;
  for (int repeated = 0; repeated < 20; ++repeated) {
    Eigen::MatrixXd two = P;
    both.subtract(two, Y);
    ASSERT_TRUE(one == two);
  }
  EXPECT_FALSE(one == P);
}

TEST(Cholesky, FactorTimesItsTransposeIsTheMatrix) {
  RandomSource random(9);
  for (const int m : {2, 6, 20, 64, 70}) {
    Eigen::MatrixXd root(m, m);
    for (double& value : root.reshaped()) value = random.normal();
    const Eigen::MatrixXd S = root * root.transpose() + Eigen::MatrixXd::Identity(m, m);
    Eigen::MatrixXd L;
    ASSERT_TRUE(choleskyOf(S, L)) << m;
    const Eigen::MatrixXd lower = L.triangularView<Eigen::Lower>();
    EXPECT_LT((lower * lower.transpose() - S).norm(), 1e-14 * m * S.norm()) << m;
    EXPECT_GT((lower * lower.transpose() - 1.001 * S).norm(), 1e-4 * S.norm()) << "must fail";
  }
}

TEST(Cholesky, RefusesWhatIsNotPositiveDefiniteOrNotFinite) {
  Eigen::MatrixXd L;
  for (const int m : {2, 20, 70}) {
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(m, m);
    EXPECT_TRUE(choleskyOf(1e-300 * one, L));
    EXPECT_FALSE(choleskyOf(-one, L));
    EXPECT_FALSE(choleskyOf(Eigen::MatrixXd::Zero(m, m), L));
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      for (const int row : {0, m - 1}) {
        Eigen::MatrixXd S = one;
        S(row, row) = bad;
        EXPECT_FALSE(choleskyOf(S, L)) << m << ' ' << row << ' ' << bad;
        S = one;
        S(m - 1, 0) = S(0, m - 1) = bad;
        EXPECT_FALSE(choleskyOf(S, L)) << m << ' ' << bad;
      }
    }
  }
}

TEST(RightSolve, UndoesTheProductWithLTransposed) {
  RandomSource random(8);
  for (const int size : {1, 3, 8, 33, 36, 37, 203}) {
    for (const int m : {2, 20, 130}) {
      Eigen::MatrixXd L = Eigen::MatrixXd::Identity(m, m) * 20.0;
      Eigen::MatrixXd Y(size, m);
      for (double& value : L.reshaped()) value += random.normal();
      for (double& value : Y.reshaped()) value = random.normal();
      Eigen::MatrixXd solved;
      solveFromTheRight(L, Y * L.triangularView<Eigen::Lower>().transpose(),
                        solved);  // what is above L's diagonal must not matter
      EXPECT_LT((solved - Y).cwiseAbs().maxCoeff(), 1e-12);
      solveFromTheRight(L, Y * L.triangularView<Eigen::Lower>(), solved);
      EXPECT_GT((solved - Y).cwiseAbs().maxCoeff(), 1e-3) << "must fail: not transposed";
    }
  }
}

}  // namespace
}  // namespace slamscope::slam
