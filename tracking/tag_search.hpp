// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "tracking/camera_model.hpp"
#include "tracking/tag_detector.hpp"
#include "tracking/tag_layout.hpp"

namespace slamscope::tracking {

struct TagSearchOptions {
  TagDetectorOptions detector;  ///< its camera is set to the search's own
  int whole_every = 15;         ///< pictures; the others are searched near the prediction only
  double margin_px = 12;        ///< around a predicted tag, beside half of its own size
};

/// Finds the tags of one camera picture by picture: near where they are predicted, and in the whole
/// picture now and then, or when nothing is predicted or less than half of what is was found.
class TagSearch {
 public:
  TagSearch(const CameraModel& camera, TagLayout layout, TagSearchOptions options = {});

  /// All tags found, as TagDetector::detect. `T_camera_world`: where the camera is believed to be
  /// at the picture's time; nothing: the whole picture is searched. `also_px`: centres of further
  /// tags to look at (the robot's, where it was last), with the half side of their square.
  struct Place {
    Eigen::Vector2d px;
    double half_px;
  };
  [[nodiscard]] std::vector<TagDetection> find(
      const ImageView& picture, const std::optional<Eigen::Isometry3d>& T_camera_world,
      const std::vector<Place>& also = {});
  /// The picture searched last was searched whole.
  [[nodiscard]] bool whole() const { return whole_; }
  /// "the picture is mirrored": no tag was found for a while, but there are some in the picture's
  /// mirror image. Empty when all is well.
  [[nodiscard]] std::string problem() const { return mirrored_ ? "the picture is mirrored" : ""; }

 private:
  [[nodiscard]] std::vector<PixelRegion> regions(const Eigen::Isometry3d& T_camera_world,
                                                 const std::vector<Place>& also,
                                                 int& expected) const;

  CameraModel camera_;
  TagLayout layout_;
  TagSearchOptions options_;
  TagDetector detector_;
  void lookIntoTheMirror(const ImageView& picture, bool found);

  int since_whole_ = 0;
  int without_tags_ = 0;  // pictures in a row
  bool whole_ = false, mirrored_ = false;
};

}  // namespace slamscope::tracking
