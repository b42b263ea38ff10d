// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tracking/room_calibration.hpp"

namespace slamscope::tracking {

/// A first idea of the room: the gauge tag at the world's origin, then tag by tag what is seen
/// beside tags that are known already, each where it fits best in all pictures of it.
struct RoomStart {
  TagLayout layout;                                              ///< tags that could be reached
  std::vector<std::optional<Eigen::Isometry3d>> T_camera_world;  ///< by picture
};
[[nodiscard]] RoomStart startRoom(std::span<const CameraModel> cameras,
                                  std::span<const RoomPicture> pictures, const MappedTag& gauge,
                                  const std::vector<MappedTag>& sizes, const std::string& family);

}  // namespace slamscope::tracking
