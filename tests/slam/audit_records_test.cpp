// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <optional>

#include "tests/slam/audit_runs.hpp"

namespace slamscope::slam {
namespace {

TEST(AuditRecords, ANaNIsAFindingAndAllBeforeItIsJudged) {
  std::optional<std::uint64_t> first;
  const AuditReport report = auditRun(oneLoop(1), {}, [&](Snapshot& s) {
    if (s.sequence < 200) return;
    if (!first) first = s.sequence;
    s.pose[0] = std::numeric_limits<double>::quiet_NaN();
  });
  ASSERT_TRUE(first);
  EXPECT_EQ(report.verdict, Verdict::violation);
  EXPECT_TRUE(report.found(FaultClass::code));
  EXPECT_EQ(report.law(Law::finite).first_record, first);
  EXPECT_EQ(report.law(Law::support).status, LawStatus::ok);
  EXPECT_EQ(exitStatus(report), 1);
}

TEST(AuditRecords, AnInfiniteCovarianceBlamesItsFeature) {
  const AuditReport report = auditRun(oneLoop(1), {}, [](Snapshot& s) {
    if (s.sequence < 200) return;
    const int row = Snapshot::row(*s.indexOf(4));
    s.covariance(row, row) = std::numeric_limits<double>::infinity();
  });
  EXPECT_EQ(blamedFeatures(report.law(Law::finite)), std::vector<FeatureId>{4});
}

TEST(AuditRecords, AsymmetryBeyondRoundingIsAFinding) {
  const auto with = [](double asymmetry) {
    return auditRun(oneLoop(1), {},
                    [=](Snapshot& s) { s.asymmetry = asymmetry * s.covariance(0, 0); });
  };
  EXPECT_EQ(with(1e-16).law(Law::symmetric).status, LawStatus::ok);
  EXPECT_EQ(with(1e-3).law(Law::symmetric).status, LawStatus::violated);
}

TEST(AuditRecords, AnIndefiniteCovarianceIsAFinding) {
  const AuditReport report = auditRun(oneLoop(1), {}, [](Snapshot& s) {
    if (s.featureCount() < 8 || s.sequence < 300) return;
    const int a = Snapshot::row(*s.indexOf(2));
    const int b = Snapshot::row(*s.indexOf(6));
    s.covariance(a, b) = 1.5 * std::sqrt(s.covariance(a, a) * s.covariance(b, b));
  });
  EXPECT_EQ(report.law(Law::positive).status, LawStatus::violated);
  const std::vector<FeatureId> blamed = blamedFeatures(report.law(Law::positive));
  EXPECT_TRUE(std::find(blamed.begin(), blamed.end(), 2) != blamed.end());
}

TEST(AuditRecords, ADiagonalLogIsLevelZeroAndStillCatchesGrowth) {
  const auto diagonal = [](Snapshot& s) {
    s.diagonal_only = true;
    for (int i = 0; i < s.covariance.size(); ++i) {
      for (int j = 0; j < i; ++j) s.covariance(i, j) = 0.0;
    }
  };
  const AuditLog steps{.every_event = false};
  const AuditReport healthy = auditRun(oneLoop(1), steps, diagonal);
  EXPECT_EQ(healthy.level, "L0");
  EXPECT_EQ(healthy.verdict, Verdict::ok) << brokenLaws(healthy);
  SimulationOptions faulty = oneLoop(1);
  faulty.fault = "paper";
  faulty.fault_features = {8};
  const AuditReport report = auditRun(faulty, steps, diagonal);
  EXPECT_EQ(blamedFeatures(report.law(Law::shrink)), std::vector<FeatureId>{8});
}

TEST(AuditRecords, CovariancesWithoutMeansAreLevelC) {
  const AuditReport report =
      auditRun(oneLoop(1), {.every_event = false},
               [](Snapshot& s) {
                 s.pose.setConstant(std::numeric_limits<double>::quiet_NaN());
                 for (Eigen::Vector2d& f : s.features) f.setZero();
               },
               {.allow = {}, .means_known = false});
  EXPECT_EQ(report.level, "LC");
  EXPECT_EQ(report.verdict, Verdict::ok) << brokenLaws(report);
  EXPECT_EQ(report.law(Law::shrink).status, LawStatus::ok);
}

TEST(AuditRecords, AlarmsNameTheFeatureWithItsLastGoodSize) {
  SimulationOptions options = oneLoop(1);
  options.fault = "paper";
  options.fault_features = {8};
  Simulation simulation(options);
  Audit audit({}, simulation.header());
  const Subscription subscription = audit.listen(simulation.filter());
  while (simulation.step()) {
  }
  const Alarms alarms = audit.alarms();
  ASSERT_EQ(alarms.features.size(), 1U);
  EXPECT_EQ(alarms.features[0].feature, 8U);
  EXPECT_TRUE(alarms.features[0].active);
  ASSERT_TRUE(alarms.features[0].last_good);
  EXPECT_EQ(alarms.pairs.size(), simulation.filter().state().ids.size() - 1);
  for (const PairAlarm& pair : alarms.pairs) EXPECT_TRUE(pair.a == 8 || pair.b == 8);
}

}  // namespace
}  // namespace slamscope::slam
