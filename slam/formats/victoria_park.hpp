// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "slam/recording.hpp"

namespace slamscope::slam {

/// Reads the Victoria Park drive as it was recorded (Guivant and Nebot, ACFR): speed and steering
/// of a pick-up truck, laser scans of 361 returns over 180°, GPS. `directory` holds
/// `victoria_park_ascii.zip`, or its files DRS.txt, LASER.txt and GPS.txt unpacked.
///
/// The GPS becomes the true path, in a frame of its own, without headings; jumps and gaps are
/// masked. The published geometry of truck and laser is set. Throws std::runtime_error "file: …"
/// for what can't be read; a last scan that is cut off is left out and said so.
[[nodiscard]] Recording readVictoriaPark(const std::string& directory);

}  // namespace slamscope::slam
