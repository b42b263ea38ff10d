// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "slam/audit/audit_report.hpp"

namespace slamscope::slam {

/// Broken laws of one class that began together and blame the same features: one paragraph of a
/// report. Points into the report; never empty.
using Finding = std::vector<const LawReport*>;

/// In the order of the laws.
[[nodiscard]] std::vector<Finding> findingsOf(const AuditReport& report);

/// "laws are broken", "no law is broken", "no exact law is broken, with a warning" where only the
/// linearisation shows, "too little to judge"
[[nodiscard]] std::string_view verdictWords(const AuditReport& report);

/// Why there is no verdict: "1 correction could be checked (an update, or a time step …" Empty
/// where there is one.
[[nodiscard]] std::string missingWords(const AuditReport& report);

/// "921 records from t = 0.00 s to 45.40 s, level L2, numbers: double"
[[nodiscard]] std::string runWords(const AuditReport& report);

/// "+0.007008", and "at most +0.006987" where the law gives a bound: of a piece of evidence.
[[nodiscard]] std::string givenText(const Evidence& evidence);
[[nodiscard]] std::string lawfulText(const Evidence& evidence);

/// "6.10 s"
[[nodiscard]] std::string timeText(double time_s);

}  // namespace slamscope::slam
