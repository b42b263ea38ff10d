// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "slam/recording.hpp"

namespace slamscope::slam {

/// Reads range-bearing sightings as MRPT's `rawlog-edit` writes them in text, six columns a line:
/// time stamp (s), index, id (−1: not known), range (m), yaw (rad), pitch (rad, not used).
///
/// Beside NAME_range_bearing.txt may lie, as `simul-landmarks` writes them, NAME_ground_truth.txt
/// (x y z … id, a landmark a line) and NAME_ground_truth_robot_path.txt (x y z yaw pitch roll, a
/// line for each time stamp in order). There is no odometry in this text: the robot may move
/// anywhere between two times, as far as the σ of the odometry allows. Throws std::runtime_error
/// "file:line: …".
[[nodiscard]] Recording readMrptSightings(const std::string& path);

}  // namespace slamscope::slam
