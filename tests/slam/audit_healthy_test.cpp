// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/slam/audit_runs.hpp"

namespace slamscope::slam {
namespace {

void expectNoCodeFault(const SimulationOptions& options, const AuditLog& log = {}) {
  const AuditReport report = auditRun(options, log);
  EXPECT_FALSE(report.found(FaultClass::code))
      << "seed " << options.seed << ", n = " << options.features << ": " << brokenLaws(report);
}

TEST(AuditHealthy, NoLawIsBrokenOverSeedsWorldsAndUpdateModes) {
  for (const UpdateMode update : {UpdateMode::batch, UpdateMode::sequential}) {
    for (const WorldKind world :
         {WorldKind::three_clusters, WorldKind::uniform, WorldKind::one_cluster}) {
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SimulationOptions options = oneLoop(seed);
        options.update = update;
        options.world = world;
        const AuditReport report = auditRun(options);
        EXPECT_EQ(report.verdict, Verdict::ok) << "seed " << seed << ": " << brokenLaws(report);
        EXPECT_EQ(report.level, "L2");
        EXPECT_EQ(report.precision, "double");
      }
    }
  }
}

TEST(AuditHealthy, ChecksEveryLawThatTheLevelAllows) {
  const AuditReport report = auditRun(oneLoop(1));
  for (const Law law : {Law::finite, Law::positive, Law::shrink, Law::support, Law::rank,
                        Law::range, Law::map_still, Law::motion, Law::process_noise,
                        Law::initialise, Law::nis, Law::sensor_noise}) {
    EXPECT_EQ(report.law(law).status, LawStatus::ok) << lawName(law);
    EXPECT_GT(report.law(law).checked, 0U) << lawName(law);
  }
  for (const Law law : {Law::symmetric, Law::heading_floor, Law::nees, Law::whiteness}) {
    EXPECT_EQ(report.law(law).status, LawStatus::not_checkable) << lawName(law);
    EXPECT_FALSE(report.law(law).reason.empty()) << lawName(law);
  }
}

TEST(AuditHealthy, NoCodeFaultWithTwoToSixtyFeatures) {
  for (const int features : {2, 3, 5, 60}) {
    SimulationOptions options = oneLoop(4);
    options.features = features;
    expectNoCodeFault(options);
    expectNoCodeFault(options, {.every_event = false});
  }
}

TEST(AuditHealthy, NoCodeFaultWithRelativePositions) {
  for (const UpdateMode update : {UpdateMode::batch, UpdateMode::sequential}) {
    SimulationOptions options = oneLoop(5);
    options.sensor = Sensor::relative_position;
    options.update = update;
    expectNoCodeFault(options);
  }
}

TEST(AuditHealthy, NoCodeFaultWithALooseStart) {
  for (const double sigma : {0.005, 0.05, 0.2}) {
    SimulationOptions options = oneLoop(6);
    options.initial_sigma = {0.1, 0.1, sigma};
    expectNoCodeFault(options);
  }
}

TEST(AuditHealthy, NoCodeFaultWhereObservedIsNotInTheLog) {
  for (const bool every_event : {true, false}) {
    expectNoCodeFault(oneLoop(7), {.every_event = every_event, .observed = false});
  }
}

TEST(AuditHealthy, NoCodeFaultInRoundedLogs) {
  for (const UpdateMode update : {UpdateMode::batch, UpdateMode::sequential}) {
    for (const int digits : {8, 7, 6}) {
      for (const bool every_event : {true, false}) {
        SimulationOptions options = oneLoop(8);
        options.update = update;
        expectNoCodeFault(options, {.every_event = every_event, .digits = digits});
      }
    }
  }
}

TEST(AuditHealthy, RemovedAndReinitialisedFeaturesAreLawful) {
  Simulation simulation(oneLoop(9));
  Audit audit({}, simulation.header());
  const Subscription subscription = audit.listen(simulation.filter());
  for (int step = 0; simulation.step(); ++step) {
    if (step % 20 == 10 && simulation.filter().knows(3)) simulation.filter().remove(3);
  }
  const AuditReport report = audit.report();
  EXPECT_FALSE(report.found(FaultClass::code)) << brokenLaws(report);
}

TEST(AuditHealthy, AStepThatRepeatsTheLastRecordIsPassedOver) {
  Simulation simulation(oneLoop(1));
  Audit all({}, simulation.header());
  Audit events({}, simulation.header());
  const Subscription listens_to_all = all.listen(simulation.filter());
  const Subscription listens_to_events = simulation.filter().observe(
      kRecordAll, [&](const SnapshotPtr& snapshot) { events.take(snapshot); });
  while (simulation.step()) {
  }
  EXPECT_EQ(all.report().records, events.report().records);
}

}  // namespace
}  // namespace slamscope::slam
