// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

namespace slamscope::tracking {

/// A tag of known place. Tag frame: see tagCorners().
struct MappedTag {
  int id = 0;
  double size_m = 0;  ///< side of the black square
  Eigen::Isometry3d T_world_tag = Eigen::Isometry3d::Identity();
};

/// Tags of the room, floor or board that never move. World: z up, the floor is z = 0.
struct TagLayout {
  std::string family = "36h11";
  std::vector<MappedTag> tags;

  /// The tag of this id, or null.
  [[nodiscard]] const MappedTag* find(int id) const;
};

/// Reads tags.yaml:
///
///     family: 36h11          # optional
///     size_m: 0.16           # optional: for tags that don't give their own
///     tags:
///       - {id: 1, T_world_tag: {position_m: [-1, -1, 0], rpy_deg: [0, 0, 90]}}
///       - {id: 2, size_m: 0.2, T_world_tag: {position_m: [1, 1, 0], quaternion_xyzw: [0, 0, 0,
///       1]}}
///       - {id: 3, T_world_tag: [[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}
///       - {id: 4, position_m: [0, 2, 0]}   # short for T_world_tag, no rotation: flat on the floor
///
/// rpy: roll about x, then pitch about y, then yaw about z, axes fixed (as ROS). Throws
/// std::runtime_error naming file, tag, field and what was expected; also for an id given twice.
[[nodiscard]] TagLayout readTagLayout(const std::filesystem::path& file);
/// Writes what readTagLayout reads (poses as matrices, to the last digit).
void writeTagLayout(const TagLayout& layout, const std::filesystem::path& file);

}  // namespace slamscope::tracking
