// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "slam/audit/report_json.hpp"
#include "slam/audit/report_junit.hpp"
#include "slam/audit/report_text.hpp"
#include "tests/slam/audit_runs.hpp"

namespace slamscope::slam {
namespace {

AuditReport faulty() {
  SimulationOptions options = oneLoop(1);
  options.fault = "paper";
  options.fault_features = {8};
  return auditRun(options);
}

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST(AuditText, NamesLawTimeFeatureAndMistake) {
  const std::string text = reportText(faulty());
  EXPECT_TRUE(contains(text, "CODE FAULT")) << text;
  EXPECT_TRUE(contains(text, "shrink, support")) << text;
  EXPECT_TRUE(contains(text, "from t = ")) << text;
  EXPECT_TRUE(contains(text, "feature           8\n")) << text;
  EXPECT_TRUE(contains(text, "likely            the covariance of these features is written"))
      << text;
  EXPECT_TRUE(contains(text, "not checked")) << text;
}

TEST(AuditText, SaysWhereTheLawGivesABound) {
  const std::string text = reportText(faulty());
  const std::size_t line = text.find("variance of feature 8 in ");
  ASSERT_NE(line, std::string::npos) << text;
  EXPECT_LT(text.find(", lawful at most +", line), text.find('\n', line)) << text;
}

TEST(AuditText, CallsLinearisationAloneAWarning) {
  SimulationOptions options = oneLoop(1);
  options.initial_sigma = Eigen::Vector3d(0.01, 0.01, 0.2);
  const std::string text = reportText(auditRun(options));
  EXPECT_TRUE(contains(text, "no exact law is broken, with a warning")) << text;
  EXPECT_TRUE(contains(text, "LINEARISATION")) << text;
  EXPECT_TRUE(contains(text, "lawful at least +0.2\n")) << text;
}

TEST(AuditText, IsAtMostAHundredWide) {
  const std::string text = reportText(faulty());
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    EXPECT_LE(end - begin, 140U) << text.substr(begin, end - begin);
    begin = end + 1;
  }
}

TEST(AuditText, ALogOfTimeStepsEndsWithTheLinesForLevelTwo) {
  const std::string text = reportText(auditRun(oneLoop(1), {.every_event = false}));
  EXPECT_TRUE(contains(text, "record.predicted(x, P, t)")) << text;
  EXPECT_TRUE(contains(text, "record.updated(x, P, [ids])")) << text;
  EXPECT_TRUE(contains(text, "record.initialised(x, P, [ids])")) << text;
}

TEST(AuditJson, HoldsTheSchema) {
  const auto json = nlohmann::json::parse(reportJson(faulty()));
  EXPECT_EQ(json["verdict"], "violation");
  EXPECT_EQ(json["classes"]["code_fault"], true);
  EXPECT_EQ(json["classes"]["linearisation"], false);
  EXPECT_EQ(json["level"], "L2");
  EXPECT_EQ(json["laws"].size(), static_cast<std::size_t>(kLawCount));
  const auto& support = json["laws"][static_cast<std::size_t>(Law::support)];
  EXPECT_EQ(support["law"], "support");
  EXPECT_EQ(support["status"], "violated");
  EXPECT_EQ(support["blame"][0]["feature"], 8);
  EXPECT_EQ(support["blame"][0]["share"], 1.0);
  EXPECT_TRUE(support["first_record"].is_number());
  EXPECT_TRUE(json["laws"][static_cast<std::size_t>(Law::nees)]["first_record"].is_null());
  EXPECT_TRUE(json["likely"].is_array());
}

TEST(AuditJunit, FailsForTheClassesAskedFor) {
  const AuditReport report = faulty();
  const std::string xml = reportJunit(report, "run <1>");
  EXPECT_TRUE(contains(xml, "<testsuite name=\"run &lt;1&gt;\" tests=\"18\""));
  EXPECT_TRUE(contains(xml, "<failure type=\"code\""));
  EXPECT_TRUE(contains(xml, "<skipped message="));
  EXPECT_FALSE(contains(reportJunit(report, "run", {}), "<failure"));
}

TEST(AuditExit, FollowsFailOn) {
  const AuditReport report = faulty();
  EXPECT_EQ(exitStatus(report), 1);
  EXPECT_EQ(exitStatus(report, {FaultClass::linearisation}), 0);
  EXPECT_EQ(exitStatus(auditRun(oneLoop(1))), 0);
}

TEST(AuditNames, AreReadBack) {
  for (const FaultClass c : {FaultClass::code, FaultClass::statistics, FaultClass::linearisation}) {
    EXPECT_EQ(faultClassFromName(faultClassName(c)), c);
  }
  for (int k = 0; k < 8; ++k) {
    const auto allow = static_cast<Allow>(k);
    EXPECT_EQ(allowFromName(allowName(allow)), allow);
  }
  EXPECT_THROW(static_cast<void>(allowFromName("nonesuch")), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(faultClassFromName("nonesuch")), std::invalid_argument);
  EXPECT_THROW(Audit({.allow = {}, .alpha = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::slam
