// SPDX-License-Identifier: MIT
#include "slam/audit/report_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace slamscope::slam {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

template <typename Value>
Json optional(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json lawJson(const LawReport& law) {
  Json blame = Json::array();
  for (const Blame& b : law.blame) {
    blame.push_back({{"feature", b.feature}, {"share", number(b.share)}});
  }
  Json evidence = Json::array();
  for (const Evidence& e : law.evidence) {
    Json& json = evidence.emplace_back();
    json["what"] = e.what;
    json["given"] = number(e.given);
    json["lawful"] = number(e.lawful);
    if (e.lawful_is == LawfulIs::at_most) json["lawful_is"] = "at most";
    if (e.lawful_is == LawfulIs::at_least) json["lawful_is"] = "at least";
  }
  Json json;
  json["law"] = lawName(law.law);
  json["status"] = lawStatusName(law.status);
  json["class"] = law.fault_class ? Json(faultClassName(*law.fault_class)) : Json(nullptr);
  json["first_record"] = optional(law.first_record);
  json["first_time_s"] = optional(law.first_time_s);
  json["violations"] = law.violations;
  json["checked"] = law.checked;
  json["worst"] = number(law.worst);
  json["tolerance"] = number(law.tolerance);
  json["blame"] = std::move(blame);
  json["evidence"] = std::move(evidence);
  json["amount"] = law.amount;
  json["reason"] = law.reason;
  return json;
}

}  // namespace

std::string reportJson(const AuditReport& report) {
  Json json;
  json["verdict"] = verdictName(report.verdict);
  json["classes"] = {{"code_fault", report.found(FaultClass::code)},
                     {"statistics", report.found(FaultClass::statistics)},
                     {"linearisation", report.found(FaultClass::linearisation)}};
  json["level"] = report.level;
  json["precision"] = report.precision;
  json["records"] = report.records;
  json["corrections_checked"] = report.corrections_checked;
  json["alpha"] = report.alpha;
  json["laws"] = Json::array();
  for (const LawReport& law : report.laws) json["laws"].push_back(lawJson(law));
  json["likely"] = report.likely;
  json["hints"] = report.hints;
  json["next_level"] = report.next_level;
  return json.dump(2) + '\n';
}

}  // namespace slamscope::slam
