// SPDX-License-Identifier: MIT
#include "slam/audit/report_findings.hpp"

#include <algorithm>
#include <cstdio>

namespace slamscope::slam {
namespace {

std::string signedText(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%+.4g", value);
  return text;
}

}  // namespace

std::string givenText(const Evidence& evidence) {
  return signedText(evidence.given);
}

std::string lawfulText(const Evidence& evidence) {
  switch (evidence.lawful_is) {
    case LawfulIs::at_most:
      return "at most " + signedText(evidence.lawful);
    case LawfulIs::at_least:
      return "at least " + signedText(evidence.lawful);
    default:
      return signedText(evidence.lawful);
  }
}

std::string timeText(double time_s) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2f s", time_s);
  return text;
}

std::vector<Finding> findingsOf(const AuditReport& report) {
  std::vector<Finding> result;
  const auto ids = [](const LawReport& law) {
    std::vector<FeatureId> list;
    for (const Blame& b : law.blame) list.push_back(b.feature);
    std::sort(list.begin(), list.end());
    return list;
  };
  for (const LawReport& law : report.laws) {
    if (law.status != LawStatus::violated) continue;
    const auto mate = std::find_if(result.begin(), result.end(), [&](const Finding& finding) {
      return finding[0]->fault_class == law.fault_class &&
             finding[0]->first_record == law.first_record && ids(*finding[0]) == ids(law);
    });
    if (mate != result.end()) {
      mate->push_back(&law);
    } else {
      result.push_back({&law});
    }
  }
  return result;
}

std::string_view verdictWords(const AuditReport& report) {
  if (report.verdict == Verdict::inconclusive) return "too little to judge";
  if (report.classes.empty()) return "no law is broken";
  const bool only_warns = report.classes == std::set{FaultClass::linearisation};
  return only_warns ? "no exact law is broken, with a warning" : "laws are broken";
}

std::string missingWords(const AuditReport& report) {
  if (report.verdict != Verdict::inconclusive) return {};
  return std::to_string(report.corrections_checked) +
         " corrections (updates, or time steps where only these are logged) could be checked; a "
         "verdict takes " +
         std::to_string(kFewestCorrections);
}

std::string runWords(const AuditReport& report) {
  return std::to_string(report.records) + " records from t = " + timeText(report.first_time_s) +
         " to " + timeText(report.last_time_s) + ", level " + report.level +
         ", numbers: " + report.precision;
}

}  // namespace slamscope::slam
