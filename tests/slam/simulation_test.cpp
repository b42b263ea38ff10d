// SPDX-License-Identifier: MIT
#include "slam/simulation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>

#include "slam/angle.hpp"
#include "slam/clusters.hpp"
#include "slam/score.hpp"

namespace slamscope::slam {
namespace {

std::vector<SnapshotPtr> simulated(const SimulationOptions& options,
                                   EventSet events = {Event::step}) {
  Simulation simulation(options);
  std::vector<SnapshotPtr> log;
  const Subscription subscription =
      simulation.filter().observe(events, [&](const SnapshotPtr& s) { log.push_back(s); });
  while (simulation.step()) {
  }
  return log;
}

TEST(RandomSource, IsTheSequenceThatTheStandardFixes) {
  std::mt19937_64 engine(42);
  RandomSource random(42);
  for (int k = 0; k < 10; ++k) {
    EXPECT_EQ(random.uniform(), static_cast<double>(engine() >> 11U) / 9007199254740992.0);
  }
}

TEST(RandomSource, NormalHasMeanZeroAndVarianceOne) {
  RandomSource random(1);
  double sum = 0.0;
  double squares = 0.0;
  int beyond_two = 0;
  constexpr int kCount = 200000;
  for (int k = 0; k < kCount; ++k) {
    const double value = random.normal();
    sum += value;
    squares += value * value;
    beyond_two += std::abs(value) > 2.0 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.01);
  EXPECT_NEAR(squares / kCount, 1.0, 0.01);
  EXPECT_NEAR(static_cast<double>(beyond_two) / kCount, 0.0455, 0.002);
}

TEST(Simulation, FindsAllFeaturesOfThePapersMap) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SimulationOptions options;
    options.seed = seed;
    Simulation simulation(options);
    const Scorer scorer(simulation.filter());
    while (simulation.step()) {
    }
    const Score score = scorer.score();
    EXPECT_EQ(score.features_found, 15) << seed;
    EXPECT_LT(score.features_rms.value(), 0.10) << seed;
    EXPECT_LT(score.features_rms_aligned.value(), 0.03) << seed;
    EXPECT_LT(score.path_rms.value(), 0.08) << seed;
    EXPECT_EQ(simulation.progress(), 1.0);
  }
}

TEST(Simulation, StartsWithTheFirstClusterOnlyAndMeetsTheOthersWhileDriving) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SimulationOptions options;
    options.seed = seed;
    options.loops = 1;
    const auto log = simulated(options);
    EXPECT_EQ(log.front()->ids, (std::vector<FeatureId>{1, 2, 3, 4, 5})) << seed;
    bool two_clusters = false;
    for (const SnapshotPtr& s : log) two_clusters = two_clusters || s->ids.size() == 10;
    EXPECT_TRUE(two_clusters) << seed;
    EXPECT_EQ(log.back()->ids.size(), 15U) << seed;
  }
}

TEST(Simulation, ClustersAreThePapersThree) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SimulationOptions options;
    options.seed = seed;
    options.loops = 1;
    ClusterTracker tracker;
    int repartitions = 0;
    for (const SnapshotPtr& s : simulated(options)) {
      repartitions += tracker.update(*s).repartitioned ? 1 : 0;
    }
    ASSERT_EQ(tracker.current().count(), 3) << seed;
    EXPECT_EQ(tracker.current().members[0], (std::vector<int>{0, 1, 2, 3, 4})) << seed;
    EXPECT_EQ(repartitions, 0) << seed;
  }
}

TEST(Simulation, IsReproducible) {
  const auto one = simulated({});
  const auto two = simulated({});
  ASSERT_EQ(one.size(), two.size());
  EXPECT_EQ(one.back()->features, two.back()->features);
  EXPECT_EQ(one.back()->covariance.dense(), two.back()->covariance.dense());
  const auto other = simulated({.seed = 2});
  EXPECT_NE(one.back()->features, other.back()->features);
}

TEST(Simulation, EverySnapshotCarriesItsTruth) {
  Simulation simulation({.loops = 1});
  const Subscription subscription = simulation.filter().observe([&](const SnapshotPtr& s) {
    ASSERT_TRUE(s->truth);
    EXPECT_LT((s->truth->pose - simulation.truePose(s->time)).norm(), 1e-6);
    EXPECT_EQ(s->truth->ids.size(), 15U);
    // Estimate and truth belong to the same time: a step's lag would show as 25 mm.
    EXPECT_LT((s->truth->pose - s->pose).head<2>().norm(), 0.15);
  });
  while (simulation.step()) {
  }
  EXPECT_FALSE(simulation.step());
}

TEST(Simulation, AllEventsAreThereForWhoWantsThem) {
  const auto log = simulated({.loops = 1}, EventSet::all());
  EXPECT_EQ(log.front()->event, Event::initial);
  int initialised = 0;
  for (const SnapshotPtr& s : log) initialised += s->event == Event::initialise ? 1 : 0;
  EXPECT_EQ(initialised, 15);
}

/// Mean over runs of the normalised estimation error squared of the pose, half-way round the loop.
double meanNees(double sigma_scale) {
  double sum = 0.0;
  constexpr int kRuns = 200;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    SimulationOptions options;
    options.seed = seed;
    options.loops = 1;
    options.initial_sigma = {0.02, 0.02, 0.01};
    Simulation simulation(options);
    while (simulation.progress() < 0.5) simulation.step();
    const EkfState& state = simulation.filter().state();
    Eigen::Vector3d error = state.pose() - simulation.truth().pose;
    error[2] = wrapAngle(error[2]);
    const Eigen::Matrix3d P = state.P.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>();
    sum += error.dot(P.llt().solve(error)) * sigma_scale;
  }
  return sum / kRuns;
}

TEST(Simulation, FilterIsConsistentWithTheTruth) {
  // Mean of 200 χ² with 3 degrees of freedom: 3 ± 0.17; a linearised filter lies a little above.
  const double nees = meanNees(1.0);
  EXPECT_GT(nees, 2.4);
  EXPECT_LT(nees, 3.7);
  EXPECT_GT(meanNees(4.0), 3.7) << "a filter that takes σ for half of it must fail";
}

TEST(Simulation, OtherWorldsSensorsAndUpdatesWork) {
  for (const Sensor sensor : {Sensor::range_bearing, Sensor::relative_position}) {
    for (const UpdateMode update : {UpdateMode::batch, UpdateMode::sequential}) {
      for (const WorldKind world : {WorldKind::uniform, WorldKind::one_cluster}) {
        SimulationOptions options;
        options.world = world;
        options.features = 30;
        options.update = update;
        options.sensor = sensor;
        Simulation simulation(options);
        const Scorer scorer(simulation.filter());
        while (simulation.step()) {
        }
        EXPECT_GE(scorer.score().features_found, 29);
        EXPECT_LT(scorer.score().features_rms.value(), 0.12);
        EXPECT_EQ(simulation.header().sensor, sensor);
      }
    }
  }
}

TEST(Simulation, RefusesOptionsOutOfRange) {
  EXPECT_THROW(Simulation({.features = 0}), std::invalid_argument);
  EXPECT_THROW(Simulation({.fault = "gremlin"}), std::invalid_argument);
  EXPECT_THROW(Simulation({.sensor_sigma = Eigen::Vector2d(0.0, 0.1)}), std::invalid_argument);
  EXPECT_THROW(Simulation({.sensor = Sensor::unknown}), std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::slam
