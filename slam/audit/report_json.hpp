// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "slam/audit/audit_report.hpp"

namespace slamscope::slam {

/// The report as JSON, indented, ends with a line break. Schema of spec audit.md: `verdict`,
/// `classes`, `level`, `records`, `laws`, `likely`; besides: `precision`, `alpha`, `hints`,
/// `next_level`. Absent and non-finite numbers are null.
[[nodiscard]] std::string reportJson(const AuditReport& report);

}  // namespace slamscope::slam
