// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "slam/run_source.hpp"

namespace slamscope::slam {

/// The directory that MRPT's kf-slam (kf_implementation = CRangeBearingKFSLAM2D) logged into:
/// `full_cov_00000.txt`, … are P after each SAVE_LOG_FREQUENCY-th step. Level LC: of the means only
/// the robot's are written as numbers; `slam_state_*.m` draws the features' ellipses, rounded to
/// 0.1 mm, and in the 2.5.8 of Debian 12 with every y at 0, so nothing is taken from there.
///
/// Throws std::runtime_error "path: …" where no such file is there or the run is of the filter in
/// 3D (poses of seven numbers).
[[nodiscard]] std::unique_ptr<RunSource> openMrptDirectory(const std::string& path);

}  // namespace slamscope::slam
