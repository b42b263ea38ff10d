// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "slam/audit/audit_report.hpp"

namespace slamscope::slam {

/// The report for people, at most 100 columns wide, ends with a line break: a paragraph per broken
/// group of laws (laws, since when, features, evidence, likely mistake), a line of whole laws, what
/// could not be checked and why, and how to reach the next level.
[[nodiscard]] std::string reportText(const AuditReport& report);

}  // namespace slamscope::slam
