// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "slam/faults.hpp"
#include "tests/slam/audit_runs.hpp"

namespace slamscope::slam {
namespace {

std::string wordsOf(const AuditReport& report) {
  std::string text;
  for (const std::string& likely : report.likely) text += likely + "; ";
  return text;
}

SimulationOptions planted(std::string_view fault, std::uint64_t seed) {
  SimulationOptions options = oneLoop(seed);
  options.fault = fault;
  return options;
}

TEST(AuditFaults, PaperFaultBlamesExactlyItsFeatures) {
  const std::vector<std::vector<FeatureId>> sets{{8}, {2, 14}, {1, 4, 7, 10, 13}};
  for (const std::vector<FeatureId>& features : sets) {
    for (const UpdateMode update : {UpdateMode::batch, UpdateMode::sequential}) {
      SimulationOptions options = planted("paper", 1);
      options.fault_features = features;
      options.update = update;
      const AuditReport report = auditRun(options);
      EXPECT_TRUE(report.found(FaultClass::code));
      EXPECT_EQ(blamedFeatures(report.law(Law::support)), features) << brokenLaws(report);
      EXPECT_EQ(blamedFeatures(report.law(Law::shrink)), features) << brokenLaws(report);
      EXPECT_NE(wordsOf(report).find("outside the Kalman update"), std::string::npos);
    }
  }
}

TEST(AuditFaults, PaperFaultIsFoundAtTheRecordWhereItBegins) {
  SimulationOptions options = planted("paper", 2);
  options.fault_features = {5};
  std::optional<std::uint64_t> begins;  // the first update after the feature was born
  bool born = false;
  const AuditReport report = auditRun(options, {}, [&](Snapshot& s) {
    if (born && s.event == Event::update && !begins) begins = s.sequence;
    born = born || s.indexOf(5).has_value();
  });
  ASSERT_TRUE(begins);
  EXPECT_EQ(report.law(Law::shrink).first_record, begins);
  EXPECT_EQ(blamedFeatures(report.law(Law::shrink)), std::vector<FeatureId>{5});
}

TEST(AuditFaults, PaperFaultIsBlamedOnTheRightFeaturesFromTimeStepsAlone) {
  SimulationOptions options = planted("paper", 3);
  options.fault_features = {2, 8};
  const AuditReport report = auditRun(options, {.every_event = false});
  EXPECT_TRUE(report.found(FaultClass::code));
  EXPECT_EQ(blamedFeatures(report.law(Law::shrink)), (std::vector<FeatureId>{2, 8}))
      << brokenLaws(report);
}

/// Each fault of the catalogue with a part of what must be said of it.
struct Expected {
  const char* fault;
  FaultClass fault_class;
  const char* likely;
};

class EveryFault : public ::testing::TestWithParam<Expected> {};

TEST_P(EveryFault, IsFoundAndNamed) {
  const AuditReport report = auditRun(planted(GetParam().fault, 3));
  EXPECT_TRUE(report.found(GetParam().fault_class)) << brokenLaws(report);
  EXPECT_NE(wordsOf(report).find(GetParam().likely), std::string::npos)
      << wordsOf(report) << brokenLaws(report);
}

INSTANTIATE_TEST_SUITE_P(
    Catalogue, EveryFault,
    ::testing::Values(Expected{"paper", FaultClass::code, "outside the Kalman update"},
                      Expected{"no-cross-prediction", FaultClass::code, "not multiplied by F"},
                      Expected{"motion-jacobian-late", FaultClass::code, "heading after the move"},
                      Expected{"motion-jacobian-swapped", FaultClass::code, "sine and cosine"},
                      Expected{"motion-jacobian-transposed", FaultClass::code, "F' P F"},
                      Expected{"bearing-jacobian-1q", FaultClass::code, "-1/q"},
                      Expected{"bearing-jacobian-sign", FaultClass::code, "it is -1"},
                      Expected{"stale-linearisation", FaultClass::code, "before the prediction"},
                      Expected{"wrong-block", FaultClass::code, "another feature's columns"},
                      Expected{"initialise-uncorrelated", FaultClass::code,
                               "no covariance with the robot"},
                      Expected{"initialise-identity", FaultClass::code, "identity"},
                      Expected{"cross-not-updated", FaultClass::code, "left out of the update"},
                      Expected{"diagonal-only", FaultClass::code, "blocks on the diagonal"},
                      Expected{"noise-on-map", FaultClass::code, "added to the features"},
                      Expected{"single-precision", FaultClass::code, "single precision"},
                      Expected{"observed-twice", FaultClass::code, "applied twice"},
                      Expected{"innovation-unwrapped", FaultClass::statistics, "wrapping"},
                      Expected{"innovation-sign", FaultClass::statistics, "innovation itself"},
                      Expected{"wrong-association", FaultClass::statistics, "wrong associations"},
                      Expected{"noise-sigma", FaultClass::code, "sigma was given"},
                      Expected{"noise-degrees", FaultClass::code, "degrees squared"},
                      Expected{"noise-9x", FaultClass::code, "multiple of the declared"},
                      Expected{"noise-unrotated", FaultClass::statistics, "not rotated"}),
    [](const ::testing::TestParamInfo<Expected>& planted_one) {
      std::string name = planted_one.param.fault;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

TEST(AuditFaults, MovedFeatureIsBlamed) {
  SimulationOptions options = planted("moved-feature", 1);
  options.loops = 2;
  options.fault_features = {8};
  const AuditReport report = auditRun(options);
  EXPECT_FALSE(report.found(FaultClass::code)) << brokenLaws(report);
  EXPECT_TRUE(report.found(FaultClass::statistics));
  EXPECT_EQ(blamedFeatures(report.law(Law::nis)), std::vector<FeatureId>{8}) << brokenLaws(report);
}

TEST(AuditFaults, NoiseTooLargeIsStatisticsWhereRIsNotDeclared) {
  const AuditReport report = auditRun(planted("noise-9x", 1), {.declared = false});
  EXPECT_FALSE(report.found(FaultClass::code)) << brokenLaws(report);
  EXPECT_TRUE(report.found(FaultClass::statistics));
}

TEST(AuditFaults, MotionJacobianIsPrintedBesideTheLawfulOne) {
  const AuditReport report = auditRun(planted("motion-jacobian-transposed", 1));
  bool shown = false;
  for (const Evidence& e : report.law(Law::motion).evidence) {
    const bool third_row = e.what == "F(3,1)" || e.what == "F(3,2)";
    shown = shown || (third_row && std::abs(e.given) > 1e-4 && e.lawful == 0.0);
  }
  EXPECT_TRUE(shown);
}

}  // namespace
}  // namespace slamscope::slam
