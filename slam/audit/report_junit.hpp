// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "slam/audit/audit_report.hpp"

namespace slamscope::slam {

/// The report as JUnit XML, one test case a law: a failure where a class of `fail_on` was found,
/// skipped where the law is not checkable, the rest passed (warnings in system-out). Where there is
/// too little to judge, an error of the test case `verdict`.
[[nodiscard]] std::string reportJunit(const AuditReport& report, std::string_view run_name,
                                      const std::set<FaultClass>& fail_on = {
                                          FaultClass::code, FaultClass::statistics});

}  // namespace slamscope::slam
