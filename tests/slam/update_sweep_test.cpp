// SPDX-License-Identifier: MIT
#include "slam/audit/update_sweep.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace slamscope::slam {
namespace {

/// Entries with no pattern, the diagonal's positive.
std::shared_ptr<Snapshot> recordOf(int features, std::uint64_t seed) {
  auto snapshot = std::make_shared<Snapshot>();
  const int size = 3 + 2 * features;
  Eigen::MatrixXd numbers;
  fillProbes(seed, size, size, numbers);
  snapshot->sequence = seed;
  snapshot->covariance = PackedCovariance(size);
  for (int row = 0; row < size; ++row) {
    for (int col = 0; col < row; ++col) snapshot->covariance(row, col) = numbers(row, col);
    snapshot->covariance(row, row) = 10.0 + numbers(row, row);
  }
  for (int k = 0; k < features; ++k) {
    snapshot->ids.push_back(k + 1);
    snapshot->features.emplace_back(k, -k);
  }
  return snapshot;
}

Eigen::MatrixXd denseOf(const Snapshot& snapshot) {
  const int size = snapshot.covariance.size();
  Eigen::MatrixXd P(size, size);
  for (int row = 0; row < size; ++row) {
    for (int col = 0; col <= row; ++col) {
      P(row, col) = P(col, row) = snapshot.covariance(row, col);
    }
  }
  return P;
}

/// What a sweep over a map of so many features gathers is what dense matrices say.
void expectAsDense(int features) {
  const auto before = recordOf(features, 1);
  const auto after = recordOf(features, 2);
  after->observed_given = true;
  after->observed = {2, static_cast<FeatureId>(features)};
  const Transition t = lineUp(before, after, {});
  UpdateSweep sweep;
  sweep.take(t);
  const Eigen::MatrixXd P = denseOf(*before);
  const Eigen::MatrixXd D = P - denseOf(*after);
  const int size = t.size();
  Eigen::MatrixXd omega;
  fillProbes(after->sequence, size, 1, omega);
  const Eigen::VectorXd image = D * t.scale.cwiseProduct(omega.col(0));
  EXPECT_LT((sweep.image().head(size) - image).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_EQ(sweep.states(), (std::vector<int>{0, 1, 2, 5, 6, size - 2, size - 1}));
  EXPECT_EQ(sweep.columns().topRows(size), P(Eigen::all, sweep.states()));
  EXPECT_EQ(sweep.blockBefore(), P(sweep.states(), sweep.states()));
  EXPECT_EQ(sweep.blockOfChange(), D(sweep.states(), sweep.states()));
  EXPECT_EQ(sweep.diagonal(), D.diagonal());
  EXPECT_EQ(sweep.besideDiagonal().tail(size - 1), D.diagonal(-1));
  EXPECT_EQ(sweep.leastVariance(), denseOf(*after).diagonal().minCoeff());
  EXPECT_TRUE(sweep.finite());
}

TEST(UpdateSweep, GathersWhatDenseMatricesSay) {
  expectAsDense(15);
}

TEST(UpdateSweep, OnTwoThreadsToo) {
  expectAsDense(400);
}

TEST(UpdateSweep, SeesANumberThatIsNoneInEitherHalf) {
  for (const int row : {5, 790}) {
    const auto before = recordOf(400, 1);
    const auto after = recordOf(400, 2);
    after->covariance(row, 3) = std::nan("");
    UpdateSweep sweep;
    sweep.take(lineUp(before, after, {}));
    EXPECT_FALSE(sweep.finite()) << row;
  }
}

}  // namespace
}  // namespace slamscope::slam
