// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "slam/audit/audit_report.hpp"

namespace slamscope::slam {

/// What the law demands, in one line for somebody who has not read about it.
[[nodiscard]] std::string_view lawWords(Law law);

}  // namespace slamscope::slam
