// SPDX-License-Identifier: MIT
#include "engine/render/options.hpp"

namespace slamscope::engine {

int FrameStats::draws(const std::string& pass) const {
  int sum = 0;
  for (const Pass& each : passes) {
    if (each.name == pass) sum += each.draws;
  }
  return sum;
}

}  // namespace slamscope::engine
