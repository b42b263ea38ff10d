// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "slam/audit/audit_report.hpp"
#include "slam/audit/report_series.hpp"

namespace slamscope::slam {

/// The report as one HTML page that asks for no other file: what reportText says, the run's plots,
/// the matrix of relative covariance, and a time line to pick the record (also `#record=N`). Holds
/// reportJson in <script id="report">. `run_name` may be any text. The page's own files: page/.
[[nodiscard]] std::string reportHtml(const AuditReport& report, const ReportSeries& series,
                                     std::string_view run_name);

}  // namespace slamscope::slam
