// SPDX-License-Identifier: MIT
#include "slam/score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "slam/simulation_random.hpp"

namespace slamscope::slam {
namespace {

using Layout = std::vector<Eigen::Vector2d>;

class ScoredRun : public Subject {
 public:
  void send(const Snapshot& snapshot) { publish(std::make_shared<Snapshot>(snapshot)); }
};

Layout randomLayout(int count, RandomSource& random) {
  Layout points;
  for (int k = 0; k < count; ++k) points.emplace_back(random.uniform(-3, 3), random.uniform(-3, 3));
  return points;
}

double squares(const Layout& a, const Layout& b, const Alignment& alignment) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (alignment(a[k]) - b[k]).squaredNorm();
  return sum;
}

TEST(Alignment, RecoversARigidMotion) {
  RandomSource random(1);
  for (int k = 0; k < 100; ++k) {
    const Alignment applied{random.uniform(-3.1, 3.1),
                            {random.uniform(-5, 5), random.uniform(-5, 5)}};
    const Layout points = randomLayout(2 + k % 10, random);
    Layout moved;
    for (const Eigen::Vector2d& p : points) moved.push_back(applied(p));
    const Alignment found = alignRigid(points, moved);
    EXPECT_NEAR(std::cos(found.angle - applied.angle), 1.0, 1e-12);
    EXPECT_LT((found.translation - applied.translation).norm(), 1e-12);
  }
}

TEST(Alignment, IsTheLeastSquaresOne) {
  RandomSource random(2);
  const Layout a = randomLayout(8, random);
  const Layout b = randomLayout(8, random);
  const Alignment best = alignRigid(a, b);
  const double least = squares(a, b, best);
  for (const double step : {-1e-3, 1e-3}) {
    Alignment other = best;
    other.translation.x() += step;
    EXPECT_GT(squares(a, b, other), least);
    other = best;
    other.translation.y() += step;
    EXPECT_GT(squares(a, b, other), least);
    other = best;
    other.angle += step;
    EXPECT_GT(squares(a, b, other), least);
  }
}

TEST(Alignment, DoesNotScaleOrMirror) {
  const Layout square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const Layout larger{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_NEAR(squares(square, larger, alignRigid(square, larger)), 4 * 0.5, 1e-12);
  const Layout flag{{0, 0}, {2, 0}, {2, 1}};
  const Layout mirrored{{0, 0}, {2, 0}, {2, -1}};
  EXPECT_GT(squares(flag, mirrored, alignRigid(flag, mirrored)), 0.1);
}

TEST(Alignment, OfOnePointOnlyTranslates) {
  const Alignment alignment = alignRigid(Layout{{1, 2}}, Layout{{4, 6}});
  EXPECT_EQ(alignment.angle, 0.0);
  EXPECT_EQ(alignment.translation, Eigen::Vector2d(3, 4));
  EXPECT_THROW((void)alignRigid(Layout{}, Layout{}), std::invalid_argument);
  EXPECT_THROW((void)alignRigid(Layout{{1, 2}}, Layout{}), std::invalid_argument);
}

/// A run whose map is the truth turned by 90° and shifted, with feature 3 off by 0.3 m.
Snapshot turned(int k) {
  Snapshot s;
  s.time = std::chrono::seconds(k);
  s.event = Event::step;
  s.truth = Truth{{0.1 * k, 0.01 * k * k, 0.0}, {1, 2, 3, 4}, {{1, 0}, {2, 0}, {0, 3}, {9, 9}}};
  const Alignment turn{std::acos(0.0), {5, 0}};
  s.pose.head<2>() = turn(s.truth->pose.head<2>());
  s.ids = {3, 1, 8, 2};
  s.features = {turn({0, 3.3}), turn({1, 0}), {7, 7}, turn({2, 0})};
  return s;
}

TEST(Scorer, AlignsFeaturesAndPathEachByItsOwn) {
  ScoredRun source;
  const Scorer scorer(source);
  for (int k = 0; k < 10; ++k) source.send(turned(k));
  const Score score = scorer.score();
  EXPECT_EQ(score.features_found, 3) << "feature 8 does not exist, feature 4 was not found";
  EXPECT_EQ(score.path_samples, 10U);
  EXPECT_NEAR(score.path_rms_aligned.value(), 0.0, 1e-12);
  EXPECT_GT(score.path_rms.value(), 4.0);
  EXPECT_GT(score.features_rms.value(), 3.0);
  EXPECT_GT(score.features_rms_aligned.value(), 0.05) << "what is wrong must stay wrong";
  EXPECT_LT(score.features_rms_aligned.value(), 0.3 / std::sqrt(3.0)) << "identity is not the best";
}

TEST(Scorer, TakesTheLastSampleOfATimeAndOnlyTheEventsAskedFor) {
  ScoredRun source;
  const Scorer scorer(source);
  Snapshot wrong = turned(1);
  wrong.pose = {100, 100, 0};
  source.send(turned(0));
  source.send(wrong);
  source.send(turned(1));
  wrong.event = Event::predict;
  source.send(wrong);
  EXPECT_EQ(scorer.score().path_samples, 2U);
  EXPECT_NEAR(scorer.score().path_rms_aligned.value(), 0.0, 1e-12);
}

TEST(Scorer, SaysNothingWhereThereIsNoTruth) {
  ScoredRun source;
  const Scorer scorer(source);
  EXPECT_EQ(scorer.score().features_found, 0);
  Snapshot s = turned(0);
  s.truth->pose.setConstant(std::numeric_limits<double>::quiet_NaN());
  source.send(s);
  EXPECT_FALSE(scorer.score().path_rms);
  EXPECT_TRUE(scorer.score().features_rms);
  s.truth.reset();
  source.send(s);
  EXPECT_EQ(scorer.score().features_found, 4);
  EXPECT_FALSE(scorer.score().features_rms);
}

}  // namespace
}  // namespace slamscope::slam
