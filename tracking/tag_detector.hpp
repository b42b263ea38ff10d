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
  /// How far cells are from the grey between black and white, levels: of searched tags
  /// libapriltag's decision margin, for which it sharpens the cells.
  double margin = 0;
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

/// A tag that should be in the picture, and where.
struct ExpectedTag {
  int id = 0;
  std::array<Eigen::Vector2d, 4> corners_px;  ///< as TagDetection::corners_px
};

/// Where else TagDetector::follow looks.
struct FollowOptions {
  double margin_px = 12;                   ///< around a tag that isn't where it should be
  std::span<const PixelRegion> also = {};  ///< searched too
  bool whole_picture = false;              ///< searched too, coarsely
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
  /// The whole picture, searched at half the size of detect(): some four times as quick, and only
  /// tags of twice the size are found for sure. Corners are refined likewise.
  [[nodiscard]] std::vector<TagDetection> detectCoarsely(const ImageView& image);

  /// Tags that are where they are expected, to two pixels or so: their sides are looked for there
  /// at once, and they count where the picture shows their print. Several times quicker than a
  /// search. Those that aren't there are searched around it. Without refinement all are searched.
  [[nodiscard]] std::vector<TagDetection> follow(const ImageView& image,
                                                 std::span<const ExpectedTag> expected,
                                                 const FollowOptions& options = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slamscope::tracking
