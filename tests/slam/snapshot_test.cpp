// SPDX-License-Identifier: MIT
#include "slam/snapshot.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace slamscope::slam {
namespace {

Snapshot twoFeatures() {
  Snapshot snapshot;
  snapshot.ids = {4, 9};
  snapshot.features = {{1.0, 2.0}, {3.0, 4.0}};
  snapshot.covariance = PackedCovariance::fromLower(Eigen::MatrixXd::Identity(7, 7));
  return snapshot;
}

TEST(PackedCovariance, ReadsTheLowerTriangleRowByRow) {
  Eigen::Matrix3d P;
  P << 1, -7, -7, 2, 3, -7, 4, 5, 6;  // what stands above the diagonal must not be read
  const PackedCovariance packed = PackedCovariance::fromLower(P);
  ASSERT_EQ(packed.packed().size(), 6U);
  for (int k = 0; k < 6; ++k) EXPECT_EQ(packed.packed()[static_cast<std::size_t>(k)], k + 1.0);
  EXPECT_EQ(packed(0, 2), 4.0);
  EXPECT_EQ(packed(2, 0), 4.0);
  Eigen::Matrix3d whole;
  whole << 1, 2, 4, 2, 3, 5, 4, 5, 6;
  EXPECT_EQ(packed.dense(), whole);
  EXPECT_EQ(packed.block2(0, 1), (whole.block<2, 2>(0, 1)));
  EXPECT_EQ(packed.block2(1, 0), (whole.block<2, 2>(1, 0)));
}

TEST(PackedCovariance, WritingOneSideWritesTheOther) {
  PackedCovariance packed(3);
  packed(0, 2) = 5.0;
  EXPECT_EQ(packed(2, 0), 5.0);
}

TEST(PackedCovariance, RefusesAWrongCount) {
  EXPECT_NO_THROW(PackedCovariance(3, std::vector<double>(6)));
  EXPECT_THROW(PackedCovariance(3, std::vector<double>(9)), std::invalid_argument);
}

TEST(Snapshot, FindsFeaturesById) {
  const Snapshot snapshot = twoFeatures();
  EXPECT_EQ(snapshot.featureCount(), 2);
  EXPECT_EQ(snapshot.indexOf(9), 1);
  EXPECT_FALSE(snapshot.indexOf(1));
  EXPECT_EQ(Snapshot::row(1), 5);
}

TEST(Snapshot, FiniteLooksAtMeansAndCovariance) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(twoFeatures().finite());
  Snapshot pose = twoFeatures();
  pose.pose[2] = kNan;
  EXPECT_FALSE(pose.finite());
  Snapshot feature = twoFeatures();
  feature.features[1].y() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(feature.finite());
  Snapshot covariance = twoFeatures();
  covariance.covariance(6, 0) = kNan;
  EXPECT_FALSE(covariance.finite());
}

}  // namespace
}  // namespace slamscope::slam
