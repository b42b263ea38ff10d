// SPDX-License-Identifier: MIT
#include "apps/slamscope/verbs.hpp"

namespace slamscope::apps {

void addSlam(CLI::App&) {}

}  // namespace slamscope::apps
