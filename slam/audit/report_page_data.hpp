// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "slam/audit/audit_report.hpp"
#include "slam/audit/report_series.hpp"

namespace slamscope::slam {

/// What page/*.js draws, as JSON (page/data.js reads it). Sizes stand as 16-bit codes of their
/// logarithm, little-endian in base64: 1 not finite, 2 not positive, 3 zero, else
/// log10 = lo + (code − 4) / 65531 · (hi − lo).
[[nodiscard]] std::string pageData(const AuditReport& report, const ReportSeries& series,
                                   std::string_view run_name);

}  // namespace slamscope::slam
