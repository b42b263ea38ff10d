// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/slam/audit_runs.hpp"

namespace slamscope::slam {
namespace {

/// Records of a run as they are logged.
std::vector<SnapshotPtr> recordsOf(const SimulationOptions& options, const AuditLog& log) {
  std::vector<SnapshotPtr> records;
  Simulation simulation(options);
  const Subscription subscription = simulation.filter().observe(
      log.every_event ? kRecordAll : kRecordSteps, [&](const SnapshotPtr& snapshot) {
        records.push_back(std::make_shared<Snapshot>(logged(*snapshot, log)));
      });
  while (simulation.step()) {
  }
  return records;
}

AuditReport reportOf(std::span<const SnapshotPtr> records, const AuditOptions& options = {}) {
  Audit audit(options);
  for (const SnapshotPtr& record : records) audit.take(record);
  return audit.report();
}

/// The report after as many records as make `corrections` checked ones.
AuditReport reportAfter(const std::vector<SnapshotPtr>& records, std::uint64_t corrections,
                        const AuditOptions& options = {}) {
  Audit audit(options);
  for (const SnapshotPtr& record : records) {
    audit.take(record);
    if (audit.report().corrections_checked == corrections) return audit.report();
  }
  return audit.report();
}

TEST(AuditVerdict, AHeaderAloneOneRecordAndTwoAreTooLittle) {
  const std::vector<SnapshotPtr> records = recordsOf(oneLoop(1), {});
  for (const std::size_t count : {0, 1, 2}) {
    const AuditReport report = reportOf(std::span(records).first(count));
    EXPECT_EQ(report.verdict, Verdict::inconclusive) << count;
    EXPECT_EQ(exitStatus(report), 3) << count;
  }
}

TEST(AuditVerdict, TwoRecordsWithAnUpdateBetweenThemAreTooLittle) {
  const std::vector<SnapshotPtr> records = recordsOf(oneLoop(1), {});
  const auto update = std::find_if(records.begin(), records.end(), [](const SnapshotPtr& record) {
    return record->event == Event::update;
  });
  ASSERT_NE(update, records.end());
  const AuditReport report = reportOf(std::span(update - 1, update + 1));
  EXPECT_EQ(report.corrections_checked, 1U);
  EXPECT_EQ(exitStatus(report), 3);
}

TEST(AuditVerdict, TakesTenCheckedCorrectionsAtEveryLevel) {
  for (const bool every_event : {true, false}) {
    const std::vector<SnapshotPtr> records = recordsOf(oneLoop(1), {.every_event = every_event});
    EXPECT_EQ(exitStatus(reportAfter(records, kFewestCorrections - 1)), 3) << every_event;
    EXPECT_EQ(exitStatus(reportAfter(records, kFewestCorrections)), 0) << every_event;
    const AuditOptions covariances{.allow = {}, .means_known = false};
    EXPECT_EQ(exitStatus(reportAfter(records, kFewestCorrections - 1, covariances)), 3);
    EXPECT_EQ(exitStatus(reportAfter(records, kFewestCorrections, covariances)), 0);
  }
}

TEST(AuditVerdict, RecordsInWhichNothingCanBeCheckedAreTooLittleHoweverMany) {
  std::vector<SnapshotPtr> records;
  for (int k = 0; k < 100; ++k) {  // a robot without a map
    auto record = std::make_shared<Snapshot>();
    record->time = std::chrono::milliseconds(100 * k);
    record->sequence = static_cast<std::uint64_t>(k);
    record->pose.x() = 0.1 * k;
    record->covariance = PackedCovariance(3);
    for (int i = 0; i < 3; ++i) record->covariance(i, i) = 0.01 * k;
    records.push_back(record);
  }
  const AuditReport report = reportOf(records);
  EXPECT_EQ(report.verdict, Verdict::inconclusive);
  EXPECT_EQ(report.corrections_checked, 0U);
}

TEST(AuditVerdict, ABrokenLawIsSaidOfTwoRecordsAlready) {
  SimulationOptions options = oneLoop(1);
  options.fault = "paper";
  options.fault_features = {1};
  const std::vector<SnapshotPtr> records = recordsOf(options, {});
  const auto update = std::find_if(records.begin(), records.end(), [](const SnapshotPtr& record) {
    return record->event == Event::update;
  });
  ASSERT_NE(update, records.end());
  const AuditReport report = reportOf(std::span(update - 1, update + 1));
  EXPECT_EQ(report.verdict, Verdict::violation);
  EXPECT_EQ(exitStatus(report), 1);
}

}  // namespace
}  // namespace slamscope::slam
