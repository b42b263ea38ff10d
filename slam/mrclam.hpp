// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "slam/recording.hpp"

namespace slamscope::slam {

/// Reads one robot of a UTIAS MR.CLAM data set (Leung et al., IJRR 30(8), 2011): odometry,
/// sightings (barcode → subject by Barcodes.dat; subjects 6–20 are the landmarks, 1–5 the robots,
/// which are ignored and counted; unknown barcodes are counted), truth where its files are there.
/// Throws std::runtime_error "file:line: field: what was expected, what was found".
[[nodiscard]] Recording readMrclam(const std::string& directory, int robot);

}  // namespace slamscope::slam
