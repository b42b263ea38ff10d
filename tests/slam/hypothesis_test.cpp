// SPDX-License-Identifier: MIT
#include "slam/hypothesis.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace slamscope::slam {
namespace {

using namespace std::chrono_literals;

const Eigen::Matrix2d kForkNoise = Eigen::Vector2d(0.01, 0.0004).asDiagonal();

/// A hypothesis at a loosely known place that has begun a feature at each of `readings`.
struct Story {
  explicit Story(const std::vector<Eigen::Vector2d>& readings) {
    for (const Eigen::Vector2d& z : readings) {
      const std::size_t number = next++;
      hypothesis.begin(equations, {number, 0s, {static_cast<FeatureId>(next), z, kForkNoise}});
      hypothesis.endTime();
      hypothesis.seen_now.clear();
    }
  }
  void pair(std::size_t index, const Eigen::Vector2d& z) {
    hypothesis.pair(equations, index, {next++, 100s, {0, z, kForkNoise}});
  }
  [[nodiscard]] Eigen::MatrixXd covariance() const {
    return hypothesis.state.P.selfadjointView<Eigen::Lower>();
  }

  EkfEquations equations{Sensor::range_bearing};
  Hypothesis hypothesis = Hypothesis::atOrigin({0.3, 0.3, 0.1});
  std::size_t next = 0;
};

TEST(Hypothesis, UpdatesAsTheFilterDoes) {
  Story story({{3.0, 0.1}, {2.0, -0.4}});
  EkfState plain = story.hypothesis.state;
  const Observation reading{2, {2.1, -0.38}, kForkNoise};
  story.equations.update(plain, {&reading, 1});
  story.pair(1, reading.z);
  EXPECT_LT((story.hypothesis.state.x - plain.x).norm(), 1e-12);
  EXPECT_LT((story.covariance() - Eigen::MatrixXd(plain.P.selfadjointView<Eigen::Lower>())).norm(),
            1e-12);
}

TEST(Hypothesis, ACopyGoesItsOwnWay) {
  Story story({{3.0, 0.1}});
  const Hypothesis before = story.hypothesis;
  story.pair(0, {3.3, 0.1});
  EXPECT_EQ(before.state.featureCount(), 1);
  EXPECT_NE(before.state.x, story.hypothesis.state.x);
  EXPECT_EQ(before.labels(1), (std::vector<FeatureId>{1}));
  EXPECT_EQ(story.hypothesis.labels(2), (std::vector<FeatureId>{1, 1}));
}

/// The oracle: the same constraint as an update with dense matrices.
TEST(Hypothesis, JoinIsTheExactConstraintThatTwoFeaturesStandAtOnePlace) {
  Story story({{3.0, 0.10}, {2.0, -0.5}, {3.1, 0.12}});
  const Eigen::VectorXd x = story.hypothesis.state.x;
  const Eigen::MatrixXd P = story.covariance();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2, 9);
  H.block<2, 2>(0, 3).setIdentity();
  H.block<2, 2>(0, 7) = -Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d S = H * P * H.transpose() + 1e-4 * Eigen::Matrix2d::Identity();
  const Eigen::MatrixXd W = P * H.transpose() * S.inverse();
  const Eigen::VectorXd joined = x - W * H * x;
  const Eigen::MatrixXd P_joined = P - W * S * W.transpose();

  Hypothesis::Distance apart = story.hypothesis.distance(0, 2);
  EXPECT_LT((apart.mean - H * x).norm(), 1e-12);
  EXPECT_LT((apart.covariance - H * P * H.transpose()).norm(), 1e-12);
  apart.covariance += 1e-4 * Eigen::Matrix2d::Identity();
  story.hypothesis.join(0, 2, apart);
  EXPECT_EQ(story.hypothesis.state.ids, (std::vector<FeatureId>{1, 2}));
  EXPECT_LT((story.hypothesis.state.x - joined.head(7)).norm(), 1e-12);
  EXPECT_LT((story.covariance() - P_joined.topLeftCorner(7, 7)).norm(), 1e-12);
  EXPECT_GT((x.head(7) - joined.head(7)).norm(), 1e-3)
      << "the oracle sees a join that was left out";
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> values(story.covariance());
  EXPECT_GT(values.eigenvalues().minCoeff(), -1e-12);
}

TEST(Hypothesis, LabelsFollowJoinsOfJoins) {
  Story story({{3.0, 0.1}, {3.0, 0.1}, {3.0, 0.1}, {1.0, 1.0}});
  const auto join = [&](std::size_t stays, std::size_t goes) {
    Hypothesis::Distance apart = story.hypothesis.distance(stays, goes);
    apart.covariance += 1e-4 * Eigen::Matrix2d::Identity();
    story.hypothesis.join(stays, goes, apart);
  };
  join(1, 2);
  join(0, 1);
  story.pair(0, {3.0, 0.1});
  EXPECT_EQ(story.hypothesis.labels(6), (std::vector<FeatureId>{1, 1, 1, 4, 1, 0}));
}

TEST(Hypothesis, RemembersWhatWasSeenTogetherThroughAJoin) {
  Story story({{3.0, 0.1}, {2.0, 0.1}, {3.0, 0.1}});
  story.hypothesis.seen_now = {3, 2};
  story.hypothesis.endTime();
  EXPECT_TRUE(story.hypothesis.sawTogether(2, 3));
  EXPECT_FALSE(story.hypothesis.sawTogether(1, 2));
  Hypothesis::Distance apart = story.hypothesis.distance(0, 2);
  apart.covariance += 1e-4 * Eigen::Matrix2d::Identity();
  story.hypothesis.join(0, 2, apart);
  EXPECT_TRUE(story.hypothesis.sawTogether(2, 1));
}

TEST(Hypothesis, AMillionDecisionsAreForgottenWithoutRecursion) {
  Story story({{3.0, 0.1}});
  for (std::size_t k = 1; k < 1'000'000; ++k) {
    story.hypothesis.newest = std::make_shared<Decision>(story.hypothesis.newest, k, FeatureId{1});
  }
  const std::shared_ptr<Decision> half_way = [&] {
    std::shared_ptr<Decision> decision = story.hypothesis.newest;
    for (int k = 0; k < 500'000; ++k) decision = decision->before;
    return decision;
  }();
  story.hypothesis.newest.reset();
  EXPECT_EQ(half_way->reading, 499'999U) << "what others share stays";
  EXPECT_NE(half_way->before, nullptr);
}

TEST(Hypothesis, OnlyTheSameBeliefIsAlike) {
  const Story one({{3.0, 0.1}, {2.0, -0.5}});
  const Story renamed({{2.0, -0.5}, {3.0, 0.1}});
  EXPECT_TRUE(alike(one.hypothesis, renamed.hypothesis, {}));
  const Story more({{3.0, 0.1}, {2.0, -0.5}, {1.0, 0.0}});
  EXPECT_FALSE(alike(one.hypothesis, more.hypothesis, {}));
  const Story elsewhere({{3.0, 0.1}, {4.0, -0.5}});
  EXPECT_FALSE(alike(one.hypothesis, elsewhere.hypothesis, {}));
  Story moved({{3.0, 0.1}, {2.0, -0.5}});
  moved.hypothesis.state.x[0] += 1.0;
  EXPECT_FALSE(alike(one.hypothesis, moved.hypothesis, {}));
}

}  // namespace
}  // namespace slamscope::slam
