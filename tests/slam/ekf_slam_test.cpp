// SPDX-License-Identifier: MIT
#include "slam/ekf_slam.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "slam/simulation_random.hpp"
#include "tests/slam/dense_ekf.hpp"

namespace slamscope::slam {
namespace {

using namespace std::chrono_literals;
using testing::DenseEkf;

const Eigen::Matrix2d kM = Eigen::Vector2d(0.0009, 0.0036).asDiagonal();
const Eigen::Matrix2d kR = Eigen::Vector2d(0.0036, 0.0016).asDiagonal();

Observation reading(Sensor sensor, const Eigen::Vector3d& pose, FeatureId id,
                    const Eigen::Vector2d& feature, RandomSource& random) {
  Eigen::Vector2d z = observeFeature(sensor, pose, feature);
  z += Eigen::Vector2d(0.06 * random.normal(), 0.04 * random.normal());
  return {id, z, kR};
}

/// Drives filter and textbook through the same random run; the largest difference of x and P.
double worstDifference(Sensor sensor, UpdateMode mode, double heading_sign) {
  EkfOptions options;
  options.sensor = sensor;
  options.update = mode;
  options.initial_covariance = Eigen::Vector3d(0.01, 0.02, 0.0004).asDiagonal();
  EkfSlam filter(options);
  DenseEkf textbook(sensor, options.initial_pose, options.initial_covariance);
  textbook.heading_sign = heading_sign;
  RandomSource random(11);
  std::vector<Eigen::Vector2d> features;
  for (int k = 0; k < 6; ++k) features.emplace_back(random.uniform(1, 3), random.uniform(-2, 2));
  Eigen::Vector3d pose = Eigen::Vector3d::Zero();
  double worst = 0.0;
  for (int step = 1; step <= 60; ++step) {
    const Motion motion = Motion::fromVelocity(0.3, 0.5 + 0.1 * random.normal(), 0.2, kM);
    pose = movePose(pose, motion.increment);
    std::vector<Observation> readings;
    for (int k = 0; k < 6; ++k) {
      if (random.uniform() < 0.5) {
        readings.push_back(reading(sensor, pose, static_cast<FeatureId>(10 + k),
                                   features[static_cast<std::size_t>(k)], random));
      }
    }
    filter.step(step * 200ms, motion, readings);
    textbook.predict(motion);
    std::vector<Observation> known;
    std::vector<Observation> fresh;
    for (const Observation& o : readings) (textbook.row(o.id) ? known : fresh).push_back(o);
    if (mode == UpdateMode::batch) {
      textbook.update(known);
    } else {
      for (const Observation& o : known) textbook.update(std::span(&o, 1));
    }
    for (const Observation& o : fresh) textbook.initialise(o);
    EXPECT_EQ(filter.state().ids, textbook.ids);
    worst = std::max(worst, (filter.state().x - textbook.x).cwiseAbs().maxCoeff());
    const Eigen::MatrixXd P = filter.state().P.selfadjointView<Eigen::Lower>();
    worst = std::max(worst, (P - textbook.P).cwiseAbs().maxCoeff());
  }
  return worst;
}

TEST(EkfSlam, AgreesWithTheTextbook) {
  for (const Sensor sensor : {Sensor::range_bearing, Sensor::relative_position}) {
    for (const UpdateMode mode : {UpdateMode::batch, UpdateMode::sequential}) {
      EXPECT_LT(worstDifference(sensor, mode, 1.0), 1e-11);
      EXPECT_GT(worstDifference(sensor, mode, -1.0), 1e-3) << "a wrong H must be seen";
    }
  }
}

TEST(EkfSlam, NeverReadsAboveTheDiagonal) {
  EkfOptions options;
  options.initial_covariance << 0.01, 7, 7, 0.001, 0.02, 7, 0.0, 0.0, 0.0004;
  EkfSlam spoilt(options);
  options.initial_covariance << 0.01, 0.001, 0, 0.001, 0.02, 0, 0.0, 0.0, 0.0004;
  EkfSlam clean(options);
  const Motion motion = Motion::fromVelocity(0.3, 0.2, 0.2, kM);
  const std::vector<Observation> readings{{1, {1.0, 0.2}, kR}, {2, {2.0, -0.2}, kR}};
  for (int k = 1; k < 5; ++k) {
    spoilt.step(k * 200ms, motion, readings);
    clean.step(k * 200ms, motion, readings);
  }
  EXPECT_EQ(spoilt.state().x, clean.state().x);
  EXPECT_EQ(spoilt.snapshot().covariance.dense(), clean.snapshot().covariance.dense());
}

TEST(EkfSlam, StartsFromAnExactlyKnownPose) {
  EkfSlam filter{EkfOptions{}};
  const std::vector<Observation> readings{{1, {1.0, 0.2}, kR}, {2, {2.0, -0.2}, kR}};
  filter.observe(0ns, readings);
  filter.observe(1s, readings);
  EXPECT_EQ(filter.counters().degenerate, 0U);
  EXPECT_EQ(filter.counters().observed, 2U);
  EXPECT_TRUE(filter.state().P.topLeftCorner(3, 3).isZero());
  // Two readings from a known pose: half the covariance of one.
  EXPECT_NEAR(filter.snapshot().covariance.block2(3, 3).determinant(),
              (0.0036 * 0.0016) * 1.0 / 4.0, 1e-12);
}

TEST(EkfSlam, UpdatesNeverEnlargeAndPredictionsLeaveTheMap) {
  EkfOptions options;
  options.initial_covariance = Eigen::Vector3d(0.01, 0.02, 0.0004).asDiagonal();
  EkfSlam filter(options);
  std::vector<SnapshotPtr> log;
  const Subscription subscription = filter.observe([&](const SnapshotPtr& s) { log.push_back(s); });
  RandomSource random(3);
  filter.start(0ns);
  Eigen::Vector3d pose = Eigen::Vector3d::Zero();
  for (int step = 1; step < 40; ++step) {
    const Motion motion = Motion::fromVelocity(0.3, 0.5, 0.2, kM);
    pose = movePose(pose, motion.increment);
    std::vector<Observation> readings;
    for (FeatureId id = 1; id <= 3; ++id) {
      readings.push_back(reading(options.sensor, pose, id, {1.0 + id, 0.7 * id}, random));
    }
    filter.step(step * 200ms, motion, readings);
  }
  int updates = 0;
  for (std::size_t k = 1; k < log.size(); ++k) {
    const Snapshot& now = *log[k];
    const Snapshot& before = *log[k - 1];
    EXPECT_EQ(now.sequence, before.sequence + 1);
    const Eigen::MatrixXd D =
        before.covariance.size() == now.covariance.size()
            ? Eigen::MatrixXd(before.covariance.dense() - now.covariance.dense())
            : Eigen::MatrixXd();
    if (now.event == Event::update) {
      ++updates;
      const Eigen::VectorXd eigenvalues =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(D).eigenvalues();
      EXPECT_GT(eigenvalues[0], -1e-15);
      EXPECT_GT(eigenvalues[D.rows() - 1], 0.0);
      EXPECT_LT(eigenvalues[D.rows() - 1 - 2 * static_cast<int>(now.observed.size())], 1e-14);
    } else if (now.event == Event::predict) {
      EXPECT_TRUE(D.bottomRightCorner(D.rows() - 3, D.cols() - 3).isZero(0.0));
      EXPECT_EQ(now.features, before.features);
    }
  }
  EXPECT_EQ(updates, 38);
}

TEST(EkfSlam, PublishesEachEventWithWhatItSaw) {
  EkfOptions options;
  options.update = UpdateMode::sequential;
  options.record_jacobians = true;
  EkfSlam filter(options);
  std::vector<SnapshotPtr> log;
  const Subscription subscription = filter.observe([&](const SnapshotPtr& s) { log.push_back(s); });
  filter.setTruth(Truth{{1, 2, 3}, {1}, {{4, 5}}});
  filter.start(5ns);
  const std::vector<Observation> both{{1, {1.0, 0.2}, kR}, {2, {2.0, -0.2}, kR}};
  filter.observe(5ns, both);
  const Motion motion = Motion::fromVelocity(0.3, 0.2, 0.2, kM);
  filter.step(200ms, motion, both);
  filter.remove(1);
  std::vector<Event> events;
  for (const SnapshotPtr& s : log) events.push_back(s->event);
  EXPECT_EQ(events, (std::vector<Event>{Event::initial, Event::initialise, Event::initialise,
                                        Event::step, Event::predict, Event::update, Event::update,
                                        Event::step, Event::remove}));
  EXPECT_EQ(log[1]->observed, (std::vector<FeatureId>{1}));
  EXPECT_EQ(log[3]->observed, (std::vector<FeatureId>{1, 2}));
  EXPECT_EQ(*log[4]->control, Eigen::VectorXd(Eigen::Vector2d(0.3, 0.2)));
  EXPECT_TRUE(log[4]->Q.has_value());
  EXPECT_TRUE(log[4]->observed_given);
  EXPECT_TRUE(log[4]->observed.empty());
  ASSERT_EQ(log[6]->observations.size(), 1U);
  const ObservationRecord& record = log[6]->observations[0];
  EXPECT_EQ(record.id, 2U);
  EXPECT_EQ(record.z, both[1].z);
  EXPECT_EQ(record.R, kR);
  const Eigen::MatrixXd P = log[5]->covariance.dense();
  EXPECT_LT((record.H * P * record.H.transpose() + kR - record.S).norm(), 1e-15);
  EXPECT_EQ(log[7]->observed, (std::vector<FeatureId>{1, 2}));
  EXPECT_EQ(log[8]->ids, (std::vector<FeatureId>{2}));
  EXPECT_EQ(log[8]->time, 200ms);
  for (const SnapshotPtr& s : log) EXPECT_EQ(s->truth->pose, Eigen::Vector3d(1, 2, 3));
}

TEST(EkfSlam, CountsEventsWhetherAnybodyListensOrNot) {
  const std::vector<Observation> both{{1, {1.0, 0.2}, kR}, {2, {2.0, -0.2}, kR}};
  std::vector<std::uint64_t> steps;
  for (const EventSet events : {EventSet{Event::step}, EventSet::all()}) {
    EkfSlam filter{EkfOptions{}};
    std::uint64_t last = 0;
    const Subscription subscription =
        filter.observe(events, [&](const SnapshotPtr& s) { last = s->sequence; });
    filter.observe(0ns, both);
    filter.observe(1ns, both);
    steps.push_back(last);
  }
  EXPECT_EQ(steps[0], steps[1]);
}

TEST(EkfSlam, RemovingAFeatureMarginalisesIt) {
  EkfSlam filter{EkfOptions{}};
  const Motion motion = Motion::fromVelocity(0.3, 0.2, 0.2, kM);
  const std::vector<Observation> readings{
      {1, {1.0, 0.2}, kR}, {2, {2.0, -0.2}, kR}, {3, {1.5, 0.4}, kR}};
  filter.step(1s, motion, readings);
  filter.step(2s, motion, readings);
  const Snapshot before = filter.snapshot();
  filter.remove(2);
  const Snapshot after = filter.snapshot();
  EXPECT_EQ(after.ids, (std::vector<FeatureId>{1, 3}));
  EXPECT_EQ(after.features[1], before.features[2]);
  const Eigen::MatrixXd P = before.covariance.dense();
  const std::vector<int> kept{0, 1, 2, 3, 4, 7, 8};
  EXPECT_EQ(after.covariance.dense(), P(kept, kept));
  filter.remove(3);
  EXPECT_EQ(filter.snapshot().ids, (std::vector<FeatureId>{1}));
  filter.step(3s, motion, readings);  // comes back as new features
  EXPECT_EQ(filter.state().ids, (std::vector<FeatureId>{1, 2, 3}));
  EXPECT_EQ(filter.counters().removed, 2U);
}

TEST(EkfSlam, GateLeavesOutliersOutAndCountsThem) {
  for (const UpdateMode mode : {UpdateMode::batch, UpdateMode::sequential}) {
    EkfOptions options;
    options.update = mode;
    options.gate_probability = 0.99;
    EkfSlam filter(options);
    filter.observe(0s, std::vector<Observation>{{1, {1.0, 0.2}, kR}, {2, {2.0, -0.2}, kR}});
    filter.observe(1s, std::vector<Observation>{{1, {1.9, 0.2}, kR}, {2, {2.01, -0.2}, kR}});
    EXPECT_EQ(filter.counters().gated_out, 1U);
    EXPECT_EQ(filter.counters().observed, 1U);
    EXPECT_NEAR(filter.state().x[3], std::cos(0.2), 1e-12);
  }
}

TEST(EkfSlam, GateIsTheSharePassedByAHealthyFilter) {
  EkfOptions options;
  options.gate_probability = 0.9;
  EkfSlam filter(options);
  RandomSource random(5);
  const Eigen::Vector3d pose = Eigen::Vector3d::Zero();
  // A fixed, exactly known pose and a feature known from many readings: innovations have S ≈ R.
  for (int k = 0; k < 20000; ++k) {
    filter.observe(k * 1ms,
                   std::vector<Observation>{reading(options.sensor, pose, 1, {1.0, 0.5}, random)});
  }
  EXPECT_NEAR(static_cast<double>(filter.counters().gated_out) / 20000.0, 0.1, 0.01);
}

TEST(EkfSlam, TwoReadingsOfANewFeatureInOneStep) {
  EkfSlam filter{EkfOptions{}};
  filter.observe(0s, std::vector<Observation>{{1, {1.0, 0.2}, kR}, {1, {1.1, 0.2}, kR}});
  EXPECT_EQ(filter.counters().initialised, 1U);
  EXPECT_EQ(filter.counters().observed, 1U);
  EXPECT_NEAR(filter.state().x.segment<2>(3).norm(), 1.05, 1e-12);
}

TEST(EkfSlam, LeavesAReadingOfAFeatureUnderItsFeetOut) {
  EkfSlam filter{EkfOptions{}};
  filter.observe(0s, std::vector<Observation>{{1, {0.0, 0.0}, kR}, {2, {1.0, 0.0}, kR}});
  filter.observe(1s, std::vector<Observation>{{1, {0.1, 0.0}, kR}, {2, {1.0, 0.0}, kR}});
  EXPECT_EQ(filter.counters().degenerate, 1U);
  EXPECT_EQ(filter.counters().observed, 1U);
  EXPECT_TRUE(filter.snapshot().finite());
}

TEST(EkfSlam, RefusesWhatItCanNotUse) {
  EkfSlam filter{EkfOptions{}};
  filter.observe(1s, std::vector<Observation>{{1, {1.0, 0.2}, kR}});
  const Motion motion = Motion::fromVelocity(0.3, 0.2, 0.2, kM);
  EXPECT_THROW(filter.predict(500ms, motion), std::invalid_argument);
  EXPECT_THROW(filter.initialise({1, {1.0, 0.2}, kR}), std::invalid_argument);
  EXPECT_THROW(filter.update(std::vector<Observation>{{7, {1.0, 0.2}, kR}}), std::invalid_argument);
  EXPECT_THROW(filter.remove(7), std::invalid_argument);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(filter.update(std::vector<Observation>{{1, {kNan, 0.2}, kR}}),
               std::invalid_argument);
  EXPECT_THROW(filter.predict(2s, Motion::fromVelocity(kNan, 0.2, 0.2, kM)), std::invalid_argument);
  EkfOptions gate;
  gate.gate_probability = 1.0;
  EXPECT_THROW(EkfSlam{gate}, std::invalid_argument);
  EkfOptions sensor;
  sensor.sensor = Sensor::unknown;
  EXPECT_THROW(EkfSlam{sensor}, std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::slam
