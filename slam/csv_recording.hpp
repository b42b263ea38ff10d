// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "slam/recording.hpp"

namespace slamscope::slam {

/// Reads anybody's data from a directory of CSV files, each with its header line:
///
///   odometry.csv       time_s,forward_mps,turn_radps      velocities, held until the next row
///                  or  time_s,speed_mps,steering_rad      of a car, likewise; set its `vehicle`
///                  or  time_s,dx_m,dy_m,dtheta_rad        moved since the row before, robot's
///                  frame
///   range_bearing.csv  time_s,[id,]range_m,bearing_rad[,sigma_range_m,sigma_bearing_rad]
///               or scans.csv, see csv_scans.hpp
///   truth_path.csv     time_s,x_m,y_m,theta_rad           optional
///   truth_features.csv id,x_m,y_m                         optional
///
/// Columns may stand in any order. Throws std::runtime_error "file:line: column: what was expected,
/// what was found"; for an unknown column it names the nearest known one.
[[nodiscard]] Recording readCsv(const std::string& directory);

}  // namespace slamscope::slam
