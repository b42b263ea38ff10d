// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "tracking/camera_info.hpp"
#include "tracking/yaml_fields.hpp"

namespace slamscope::tracking {

/// The fields of ROS's camera_info, of a file of its own or within another (see readCameraInfo).
[[nodiscard]] CameraInfo cameraInfoOf(const YamlField& field);
/// The same as text, each line after `indent`.
[[nodiscard]] std::string cameraInfoText(const CameraInfo& info, const std::string& indent = "");

}  // namespace slamscope::tracking
