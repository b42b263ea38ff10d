// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace slamscope::tracking::experiments {

struct WrittenWalkOptions {
  std::filesystem::path folder;  ///< made where it isn't there
  int pairs = 150;
  double fps = 30;
};

/// A walk around the lab's robot as if it were recorded, so that `slamscope hmd` can be timed
/// without the lab painting beside it: pictures/00000.jpg … (both eyes side by side), rig.yaml,
/// room.yaml, robot.yaml. Throws std::runtime_error where it can't be written.
void writeWalk(const WrittenWalkOptions& options);

}  // namespace slamscope::tracking::experiments
