// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "slam/run_reader.hpp"

namespace slamscope::apps {

/// Opens a run that a picture can be made of. Throws std::runtime_error as RunReader does, and for
/// a run of covariances alone, which has nothing to draw.
[[nodiscard]] slam::RunReader openDrawable(const std::string& path);

}  // namespace slamscope::apps
