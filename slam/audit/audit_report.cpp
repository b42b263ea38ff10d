// SPDX-License-Identifier: MIT
#include "slam/audit/audit_report.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace slamscope::slam {

std::string_view lawName(Law law) {
  static constexpr std::array<std::string_view, kLawCount> kNames{
      "finite",       "symmetric",     "positive",  "shrink",        "support",        "rank",
      "range",        "map-still",     "motion",    "process-noise", "initialise",     "nis",
      "sensor-noise", "heading-floor", "whiteness", "nis-given",     "jacobian-given", "nees"};
  return kNames.at(static_cast<std::size_t>(law));
}

std::string_view faultClassName(FaultClass fault_class) {
  switch (fault_class) {
    case FaultClass::code:
      return "code";
    case FaultClass::statistics:
      return "statistics";
    default:
      return "linearisation";
  }
}

FaultClass faultClassFromName(std::string_view name) {
  for (const FaultClass c : {FaultClass::code, FaultClass::statistics, FaultClass::linearisation}) {
    if (faultClassName(c) == name) return c;
  }
  throw std::invalid_argument("no class of the name '" + std::string(name) +
                              "'; known: code, statistics, linearisation");
}

std::string_view lawStatusName(LawStatus status) {
  switch (status) {
    case LawStatus::ok:
      return "ok";
    case LawStatus::violated:
      return "violated";
    default:
      return "not-checkable";
  }
}

std::string_view verdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::ok:
      return "ok";
    case Verdict::violation:
      return "violation";
    default:
      return "inconclusive";
  }
}

int exitStatus(const AuditReport& report, const std::set<FaultClass>& fail_on) {
  const bool failed =
      std::any_of(fail_on.begin(), fail_on.end(), [&](FaultClass c) { return report.found(c); });
  if (failed) return 1;
  return report.verdict == Verdict::inconclusive ? 3 : 0;
}

}  // namespace slamscope::slam
