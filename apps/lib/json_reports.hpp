// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "slam/run_recording.hpp"
#include "slam/run_summary.hpp"
#include "slam/score.hpp"

namespace slamscope::apps {

/// What `slamscope slam --score-json` writes; lengths in metres, null where there is no truth.
[[nodiscard]] std::string scoreJson(const slam::Score& score, const slam::RecordingRun& run);

/// What `slamscope info --json` prints.
[[nodiscard]] std::string summaryJson(const slam::RunSummary& run);

}  // namespace slamscope::apps
