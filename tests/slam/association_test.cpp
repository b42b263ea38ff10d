// SPDX-License-Identifier: MIT
#include "slam/association.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <numbers>

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "slam/ambiguous_world.hpp"
#include "slam/audit/chi_square.hpp"
#include "slam/map_builder.hpp"
#include "slam/run_recording.hpp"
#include "slam/score.hpp"
#include "slam/simulation_random.hpp"

namespace slamscope::slam {
namespace {

using namespace std::chrono_literals;

constexpr Sensor kSensor = Sensor::range_bearing;
const Eigen::Matrix2d kSightingNoise = Eigen::Vector2d(0.0025, 0.0004).asDiagonal();

/// A filter at the origin that has `features` in its map; its heading is off by `sigma` then.
struct Mapped {
  Mapped(const std::vector<Eigen::Vector2d>& features, double sigma) {
    FeatureId id = 0;
    for (const Eigen::Vector2d& feature : features) {
      filter.initialise(
          {++id, observeFeature(kSensor, Eigen::Vector3d::Zero(), feature), kSightingNoise});
    }
    const Eigen::Matrix3d M = Eigen::Vector3d(1e-4, 1e-4, sigma * sigma).asDiagonal();
    filter.predict(100ms, Motion::fromIncrement({0.01, 0, 0}, M));
  }
  EkfSlam filter{EkfOptions{}};
};

std::vector<Observation> readingsFrom(const Eigen::Vector3d& pose,
                                      const std::vector<Eigen::Vector2d>& features) {
  std::vector<Observation> readings;
  for (const Eigen::Vector2d& feature : features) {
    readings.push_back({0, observeFeature(kSensor, pose, feature), kSightingNoise});
  }
  return readings;
}

Matches match(const Mapped& map, Association association, const std::vector<Observation>& readings,
              const AssociationGates& gates = {}) {
  return Associator(kSensor, association, gates)
      .match(map.filter.state(), expectedReadings(map.filter.state(), kSensor), readings);
}

/// Four posts 0.4 m apart, seen from a heading that is off by as much as from one to the next.
const std::vector<Eigen::Vector2d> kFence{{4, -0.6}, {4, -0.2}, {4, 0.2}, {4, 0.6}};

TEST(Association, JointSeesThroughAShiftThatFoolsNearest) {
  const Mapped map(kFence, 0.08);
  const std::vector<Observation> readings = readingsFrom({0.01, 0, 0.09}, kFence);
  EXPECT_EQ(match(map, Association::joint, readings).feature, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_NE(match(map, Association::nearest, readings).feature, (std::vector<int>{0, 1, 2, 3}));
}

TEST(Association, NoFeatureIsPairedTwice) {
  const Mapped map({{3, 0}}, 0.05);
  for (const Association association : {Association::nearest, Association::joint}) {
    const Matches found = match(map, association, readingsFrom({0.01, 0, 0}, {{3, 0.1}, {3, 0}}));
    EXPECT_EQ(found.feature, (std::vector<int>{Matches::kFresh, 0}))
        << "the other one must be of something else";
  }
}

TEST(Association, BetweenTheGatesNothingIsDecided) {
  const Mapped map({{3, 0}}, 0.0);
  for (const Association association : {Association::nearest, Association::joint}) {
    const double sigma =
        std::sqrt(kSightingNoise(0, 0) + kSightingNoise(0, 0) + 1e-4);  // of the innovation's range
    const auto feature = [&](double sigmas) {
      std::vector<Observation> readings = readingsFrom({0.01, 0, 0}, {{3, 0}});
      readings[0].z[0] += sigmas * sigma;
      return match(map, association, readings, {.pair = 0.99, .fresh = 0.9999}).feature[0];
    };
    // The χ² quantiles of 2 degrees of freedom are of the squared distance: 3.035² and 4.292².
    EXPECT_EQ(feature(3.03), 0);
    EXPECT_EQ(feature(3.04), Matches::kAmbiguous);
    EXPECT_EQ(feature(4.28), Matches::kAmbiguous);
    EXPECT_EQ(feature(4.30), Matches::kFresh);
  }
}

TEST(Association, RivalsOfCloseOddsAreLeftUndecided) {
  const Mapped map({{3, -0.1}, {3, 0.1}}, 0.02);
  for (const Association association : {Association::nearest, Association::joint}) {
    const std::vector<Observation> between = readingsFrom({0.01, 0, 0}, {{3, 0.02}});
    EXPECT_EQ(match(map, association, between).feature[0], 1);
    EXPECT_EQ(match(map, association, between, {.odds = 10.0}).feature[0], Matches::kAmbiguous);
    const std::vector<Observation> both = readingsFrom({0.01, 0, 0}, {{3, 0.14}, {3, -0.14}});
    EXPECT_EQ(match(map, association, both, {.odds = 10.0}).feature, (std::vector<int>{1, 0}));
  }
}

constexpr double kFreshDensity = 0.02;  // 1/m²

/// Every set of pairings, by brute force with dense matrices.
struct BruteForce {
  const EkfState& state;
  std::vector<ExpectedReading> expected = expectedReadings(state, kSensor);
  const std::vector<Observation>& readings;
  double most = 0.0;        ///< gain
  std::vector<int> best{};  ///< of each reading: feature, or −1

  void search(std::vector<int> features) {
    const auto [squared, gain, pairs] = judge(features);
    if (pairs > 0 && !(squared <= chiSquareQuantile(0.01, 2.0 * static_cast<double>(pairs))))
      return;
    if (gain > most) {
      most = gain;
      best = features;
    }
    if (features.size() == readings.size()) return;
    features.push_back(-1);
    search(features);
    for (int f = 0; f < state.featureCount(); ++f) {
      if (std::find(features.begin(), features.end(), f) != features.end()) continue;
      features.back() = f;
      if (single(static_cast<int>(features.size()) - 1, f)) search(features);
    }
  }

  bool single(int reading, int feature) const {
    std::vector<int> features(static_cast<std::size_t>(reading) + 1, -1);
    features.back() = feature;
    return judge(features).squared <= chiSquareQuantile(0.01, 2.0);
  }

  struct Judgement {
    double squared = 0.0;
    double gain = 0.0;  ///< ln N(ν; 0, S) − Σ ln (density × range)
    int pairs = 0;
  };

  Judgement judge(const std::vector<int>& features) const {
    std::vector<Eigen::MatrixXd> rows;
    Eigen::VectorXd innovation(0);
    Judgement result;
    for (std::size_t k = 0; k < features.size(); ++k) {
      if (features[k] < 0) continue;
      const ExpectedReading& e = expected[static_cast<std::size_t>(features[k])];
      Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2, state.size());
      H.leftCols<3>() = e.H_v;
      H.middleCols<2>(3 + 2 * features[k]) = e.H_f;
      rows.push_back(H);
      innovation.conservativeResize(innovation.size() + 2);
      innovation.tail<2>() = observationDifference(kSensor, readings[k].z, e.z);
      result.gain -= std::log(2.0 * std::numbers::pi * kFreshDensity * readings[k].z[0]);
    }
    if (rows.empty()) return result;
    Eigen::MatrixXd H(innovation.size(), state.size());
    Eigen::MatrixXd R = Eigen::MatrixXd::Zero(innovation.size(), innovation.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      H.middleRows(static_cast<Eigen::Index>(2 * k), 2) = rows[k];
      R.block<2, 2>(static_cast<Eigen::Index>(2 * k), static_cast<Eigen::Index>(2 * k)) =
          kSightingNoise;
    }
    const Eigen::MatrixXd P = state.P.selfadjointView<Eigen::Lower>();
    const Eigen::MatrixXd S = H * P * H.transpose() + R;
    result.pairs = static_cast<int>(rows.size());
    const Eigen::LLT<Eigen::MatrixXd> factor(S);
    result.squared = innovation.dot(factor.solve(innovation));
    result.gain -= 0.5 * result.squared + factor.matrixLLT().diagonal().array().log().sum();
    return result;
  }
};

TEST(Association, JointAgreesWithBruteForce) {
  RandomSource random(5);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<Eigen::Vector2d> features;
    for (int k = 0; k < 5; ++k) {
      features.emplace_back(random.uniform(2, 4), random.uniform(-0.6, 0.6));
    }
    const Mapped map(features, 0.06);
    std::vector<Observation> readings =
        readingsFrom({0.01, 0, 0.06 * random.normal()}, {features[4], features[1], features[2]});
    readings.push_back({0, {3.0, random.uniform(-0.2, 0.2)}, kSightingNoise});  // spurious
    BruteForce all{.state = map.filter.state(), .readings = readings};
    all.search({});
    const Matches found =
        match(map, Association::joint, readings, {.fresh_density = kFreshDensity});
    all.best.resize(readings.size(), -1);
    for (std::size_t k = 0; k < readings.size(); ++k) {
      EXPECT_EQ(std::max(found.feature[k], -1), all.best[k]) << trial;
    }
    EXPECT_NEAR(found.gain, all.most, 1e-9 * (1.0 + all.most));
  }
}

/// After a long blind drive any reading is inside of the gate of the only feature that is known.
TEST(Association, WhatIsLikelierNewIsNotPaired) {
  constexpr double kDense = 0.5;  // 1/m²
  const Mapped map({{3, 0}}, 0.5);
  for (const Association association : {Association::nearest, Association::joint}) {
    const auto feature = [&](double angle, double density) {
      return match(map, association,
                   readingsFrom({0.01, 0, 0}, {{3 * std::cos(angle), 3 * std::sin(angle)}}),
                   {.fresh_density = density})
          .feature[0];
    };
    EXPECT_EQ(feature(1.2, 1e-9), 0) << "so far aside is within three sigma";
    EXPECT_EQ(feature(1.2, kDense), Matches::kFresh);
    EXPECT_EQ(feature(0.1, kDense), 0) << "and this is where it stands";
  }
}

TEST(Association, ASearchThatIsCutShortSaysSo) {
  std::vector<Eigen::Vector2d> crowd;
  for (int k = 0; k < 30; ++k) crowd.emplace_back(4.0, 0.02 * k);
  const Mapped map(crowd, 0.1);
  const std::vector<Observation> readings = readingsFrom({0.01, 0, 0.0}, crowd);
  EXPECT_TRUE(match(map, Association::joint, readings, {.search_limit = 500}).cut_short);
  EXPECT_FALSE(match(Mapped(kFence, 0.02), Association::joint, readingsFrom({0.01, 0, 0}, kFence))
                   .cut_short);
}

TEST(Association, RefusesGatesThatAreNone) {
  EXPECT_THROW(Associator(kSensor, Association::known, {}), std::invalid_argument);
  EXPECT_THROW(Associator(Sensor::unknown, Association::joint, {}), std::invalid_argument);
  EXPECT_THROW(Associator(kSensor, Association::joint, {.pair = 9.21}), std::invalid_argument);
  EXPECT_THROW(Associator(kSensor, Association::joint, {.pair = 0.999, .fresh = 0.99}),
               std::invalid_argument);
  EXPECT_THROW(Associator(kSensor, Association::joint, {.odds = 0.5}), std::invalid_argument);
  EXPECT_THROW(Associator(kSensor, Association::joint, {.fresh_density = 0.0}),
               std::invalid_argument);
}

/// A robot that stands still and looks at some places, time after time.
struct Watcher {
  explicit Watcher(const FeatureLifeOptions& life, Association association = Association::nearest)
      : builder(filter, association, {}, life) {
    subscription = filter.observe([this](const SnapshotPtr& s) { log.push_back(s); });
  }

  void look(const std::vector<Eigen::Vector2d>& places) {
    time += 100ms;
    filter.predict(time, Motion{});
    builder.observe(time, readingsFrom({0, 0, 0}, places),
                    [](const Eigen::Vector2d&, const Eigen::Matrix2d&) { return true; });
  }

  EkfSlam filter{EkfOptions{}};
  MapBuilder builder;
  std::vector<SnapshotPtr> log;
  Subscription subscription;
  std::chrono::nanoseconds time{};
};

TEST(MapBuilder, ASpuriousFeatureIsTentativeAndGoesAway) {
  Watcher watcher({.confirm_after = 3, .drop_after = 2});
  watcher.look({{3, 0}});
  watcher.look({{3, 0}, {2, 1.5}});  // the wall's corner, once
  EXPECT_EQ(watcher.log.back()->tentative, (std::vector<FeatureId>{1, 2}));
  watcher.look({{3, 0}});
  EXPECT_EQ(watcher.log.back()->tentative, (std::vector<FeatureId>{2}));
  EXPECT_TRUE(watcher.builder.confirmed(1));
  watcher.look({{3, 0}});
  EXPECT_EQ(watcher.log.back()->ids, (std::vector<FeatureId>{1}));
  EXPECT_TRUE(watcher.log.back()->tentative.empty());
  EXPECT_EQ(watcher.builder.counters().dropped, 1U);
  EXPECT_TRUE(std::any_of(watcher.log.begin(), watcher.log.end(),
                          [](const SnapshotPtr& s) { return s->event == Event::remove; }));
  for (int k = 0; k < 5; ++k) watcher.look({});
  EXPECT_TRUE(watcher.filter.knows(1)) << "confirmed ones stay, unless told otherwise";
}

TEST(MapBuilder, WhatIsDoubtedForLongGoes) {
  Watcher watcher({.drop_after = 1000, .longest_doubt = 1s});
  watcher.look({{3, 0}});
  for (int k = 0; k < 10; ++k) watcher.look({});
  EXPECT_TRUE(watcher.filter.knows(1));
  watcher.look({});
  EXPECT_FALSE(watcher.filter.knows(1));
}

TEST(MapBuilder, DuplicatesAreTakenOutTheYoungerOne) {
  FeatureLifeOptions life{.confirm_after = 1, .separation = 0.5};
  Watcher watcher(life);
  for (int k = 0; k < 3; ++k) watcher.look({{3, 0}});
  watcher.filter.initialise({2, observeFeature(kSensor, {0, 0, 0}, {3.0, 0.3}), kSightingNoise});
  watcher.look({{3, 0}});
  watcher.look({{3, 0}});
  EXPECT_EQ(watcher.filter.state().ids, (std::vector<FeatureId>{1}));
  EXPECT_EQ(watcher.builder.counters().duplicates, 1U);
}

TEST(MapBuilder, StaysAliveUnderTenThousandSpuriousReturns) {
  for (const Association association : {Association::nearest, Association::joint}) {
    Watcher watcher({.drop_after = 1, .most_tentative = 20}, association);
    for (int k = 0; k < 4; ++k) watcher.look({{3, 0}, {2, 1}});
    RandomSource random(9);
    std::vector<Eigen::Vector2d> storm{{3, 0}, {2, 1}};
    for (int k = 0; k < 10000; ++k) {
      storm.emplace_back(random.uniform(0.5, 9.0), random.uniform(-9.0, 9.0));
    }
    watcher.look(storm);
    EXPECT_LE(watcher.filter.state().featureCount(), 2 + 20);
    EXPECT_GT(watcher.builder.counters().crowded, 9000U) << "and it says so";
    for (int k = 0; k < 3; ++k) watcher.look({{3, 0}, {2, 1}});
    EXPECT_EQ(watcher.filter.state().featureCount(), 2);
    EXPECT_TRUE(watcher.filter.snapshot().finite());
  }
}

struct MappedRun {
  std::uint64_t mispaired;
  double path;
};

MappedRun driveAmbiguousWorld(Association association) {
  AmbiguousWorldOptions world;
  world.spacing = 0.5;
  RecordingRun run(recordAmbiguousWorld(world), ambiguousWorldRun(world, association));
  const Scorer scorer(run.filter());
  while (run.step()) {
  }
  return {run.mispaired(), scorer.score().path_rms_aligned.value()};
}

TEST(Association, JointBeatsNearestInAnAmbiguousWorld) {
  const MappedRun nearest = driveAmbiguousWorld(Association::nearest);
  const MappedRun joint = driveAmbiguousWorld(Association::joint);
  EXPECT_LT(joint.mispaired, nearest.mispaired);
  EXPECT_LT(joint.path, nearest.path);
}

}  // namespace
}  // namespace slamscope::slam
