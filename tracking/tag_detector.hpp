// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tracking/camera_model.hpp"
#include "tracking/image_view.hpp"

namespace slamscope::tracking {

/// The tag frame: origin at the centre of the tag, looked at upright x to the right, y up, z out of
/// the paper towards the viewer. (libapriltag's own pose has y down and z into the paper: half a
/// turn about x.) A tag that lies on the floor, its upper edge towards +y of the world, has
/// T_world_tag without rotation.
///
/// Its corners are the outer corners of the black square, `size_m` apart, counter-clockwise seen by
/// the viewer from the lower left: (−h, −h), (h, −h), (h, h), (−h, h) with h = size_m / 2.
/// (tagStandard families: corners of the square where white meets black, size_m likewise.)
[[nodiscard]] std::array<Eigen::Vector3d, 4> tagCorners(double size_m);

struct TagDetection {
  int id = 0;
  /// In the order of tagCorners, in the camera's own (distorted) picture, OpenCV's convention:
  /// integer coordinates are pixel centres. (libapriltag's are half a pixel more; settled here,
  /// once.)
  std::array<Eigen::Vector2d, 4> corners_px;
  /// Standard deviation per axis of each corner, from size, blur, contrast and noise of its two
  /// sides.
  std::array<double, 4> sigma_px{};
  double margin = 0;     ///< libapriltag's decision margin, grey levels
  int hamming = 0;       ///< bits corrected
  bool refined = false;  ///< corners come from the grey profiles of the sides (see tag_corners.hpp)
};

struct TagDetectorOptions {
  /// 36h11, 25h9 or Standard41h12 (with or without "tag" in front). 16h5 is refused: it sees tags
  /// everywhere (155 false ids on 120 frames of clutter, 36h11 none).
  std::string family = "36h11";
  int threads = 1;
  /// Search for quads in a picture this much smaller. Not given: 2 from 1280 px width on, else 1
  /// (corners are refined in the full picture either way).
  std::optional<double> quad_decimate = std::nullopt;
  bool refine = true;
  int max_hamming = 2;     ///< bits corrected at most (36h11 differs in 11)
  double min_margin = 20;  ///< grey levels
  /// Sides of a tag bow under lens distortion: with the camera known, refinement allows for it.
  std::optional<CameraModel> camera = std::nullopt;
};

/// Part of a picture, px; right and bottom are outside.
struct PixelRegion {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// Finds tags. One detector for one thread at a time.
class TagDetector {
 public:
  /// Throws std::invalid_argument for a family that is unknown or refused.
  explicit TagDetector(TagDetectorOptions options = {});
  ~TagDetector();
  TagDetector(TagDetector&&) noexcept;
  TagDetector& operator=(TagDetector&&) noexcept;

  /// Tags in the picture, ids ascending. The same id may occur twice where two such tags are in
  /// view. Throws std::invalid_argument where the picture is empty or has 2 channels.
  [[nodiscard]] std::vector<TagDetection> detect(const ImageView& image);
  /// Only tags that lie within one of these regions (cut to the picture; those that overlap are
  /// searched as one). Corners are those of the whole picture.
  [[nodiscard]] std::vector<TagDetection> detect(const ImageView& image,
                                                 std::span<const PixelRegion> regions);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slamscope::tracking
