// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "slam/recording.hpp"

namespace slamscope::slam {

/// Reads laser scans, a row each:
///
///   scans.csv        time_s,angle_min_rad,angle_step_rad,r0,r1,…    m; nan or nothing: no return
///   intensities.csv  the same rows and columns, intensities for ranges; optional
///
/// Rows may differ in length: a laser that drops returns, or two of them. That, scans with no
/// return at all and scans of one time are counted in `recording.warnings`. Throws
/// std::runtime_error "file:line: column: what was expected, what was found".
void readCsvScans(const std::string& scans, const std::string& intensities, Recording& recording);

/// The warnings of `readCsvScans`, for other readers of scans.
void warnOfOddScans(Recording& recording);

}  // namespace slamscope::slam
