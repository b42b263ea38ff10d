// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "slam/recording.hpp"

namespace slamscope::slam {

/// Reads a graph of 2D poses and landmarks in iSAM's text form (Kaess, Ranganathan and Dellaert):
///
///   ODOMETRY i j dx dy dθ  sxx sxy sxt syy syt stt    moved from pose i to pose j > i
///   LANDMARK i k dx dy     sxx sxy syy                landmark k seen from pose i, robot's frame
///
/// s…: upper triangle of the square root of the information matrix. There are no times: pose i is
/// taken to be at i tenths of a second. Lines must be in order of their newest pose. Throws
/// std::runtime_error "file:line: …".
[[nodiscard]] Recording readIsamGraph(const std::string& path);

}  // namespace slamscope::slam
