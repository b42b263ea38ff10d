// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tracking/camera_model.hpp"
#include "tracking/tag_detector.hpp"
#include "tracking/tag_layout.hpp"

namespace slamscope::tracking {

/// A picture of a walk through the room.
struct RoomPicture {
  std::size_t camera = 0;
  std::vector<TagDetection> tags;
};

struct RoomCalibrationOptions {
  double size_m = 0;  ///< of tags that `sizes` doesn't name; 0: these are passed over
  std::map<int, double> sizes = {};  ///< by id, m
  std::optional<int> gauge =
      std::nullopt;             ///< tag that fixes the world; not given: the one seen most often
  std::vector<int> floor = {};  ///< tags said to lie on the floor: they make z = 0
  std::string family = "36h11";
  double corner_bias_px = 0.02;
};

/// How well one tag is known.
struct CalibratedTag {
  int id = 0;
  int pictures = 0;        ///< in which it was used
  double residual_px = 0;  ///< RMS distance of its corners
};

struct RoomCalibration {
  TagLayout layout;
  double residual_px = 0;                         ///< RMS distance over all corners used
  std::vector<std::optional<double>> picture_px;  ///< of each picture; nothing: not used
  std::vector<CalibratedTag> tags;
  double floor_m = 0;  ///< RMS height of the floor tags' corners over z = 0
  std::vector<std::string> hints;
};

/// The room's layout from a walk through it: bundle adjustment (Ceres) over all tags and all
/// pictures' poses, robust corner by corner, after a start by which tag is seen beside which. The
/// world is the gauge tag's frame (see tagCorners), or with floor tags: z = 0 the plane through
/// them, z up, the origin under the gauge tag's centre, x along its x. Throws std::runtime_error,
/// one line, where that is too weak: fewer than three pictures with two tags, tags that are never
/// seen beside others, no gauge tag,
/// or where the pictures contradict each other (another size than stated).
[[nodiscard]] RoomCalibration calibrateRoom(std::span<const CameraModel> cameras,
                                            std::span<const RoomPicture> pictures,
                                            const RoomCalibrationOptions& options);

}  // namespace slamscope::tracking
