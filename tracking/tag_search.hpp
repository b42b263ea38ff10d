// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "tracking/head_overlay.hpp"
#include "tracking/tag_detector.hpp"
#include "tracking/tag_layout.hpp"

namespace slamscope::tracking {

struct TagSearchOptions {
  TagDetectorOptions detector;  ///< its camera is set to the search's own
  int whole_every = 15;         ///< pictures; the others are searched near the prediction only
  double margin_px = 12;        ///< around a predicted tag, beside half of its own size
};

/// Finds the tags of one camera on a head, picture by picture: where they are predicted, and in the
/// whole picture now and then, or when nothing is predicted or less than half of what is was found.
/// The whole picture is searched coarsely first; small tags are then found where they are
/// predicted.
class TagSearch {
 public:
  TagSearch(EyeCamera eye, TagLayout layout, TagSearchOptions options = {});

  /// All tags found, as TagDetector::detect. `head`: how it is believed to move at the picture's
  /// mid-exposure; nothing: the whole picture is searched. `also`: centres of further tags to look
  /// at (the robot's, where it was last), with the half side of their square. `closely`: something
  /// that the layout doesn't have is sought, so small tags count in the whole picture too.
  struct Place {
    Eigen::Vector2d px;
    double half_px;
  };
  [[nodiscard]] std::vector<TagDetection> find(const ImageView& picture,
                                               const std::optional<HeadMotion>& head,
                                               const std::vector<Place>& also = {},
                                               bool closely = false);
  /// The picture searched last was searched whole (too).
  [[nodiscard]] bool whole() const { return whole_; }
  /// "the picture is mirrored": no tag was found for a while, but there are some in the picture's
  /// mirror image. Empty when all is well.
  [[nodiscard]] std::string problem() const { return mirrored_ ? "the picture is mirrored" : ""; }

 private:
  /// Tags of the layout that the camera should see whole.
  [[nodiscard]] std::vector<ExpectedTag> expected(const HeadMotion& head) const;
  [[nodiscard]] std::size_t mappedOf(const std::vector<TagDetection>& tags) const;
  /// Nothing where less than half of what should be there is.
  [[nodiscard]] std::vector<TagDetection> follow(const ImageView& picture, const HeadMotion& head,
                                                 const std::vector<Place>& also, bool whole_too);
  void lookIntoTheMirror(const ImageView& picture, bool found);

  EyeCamera eye_;
  TagLayout layout_;
  TagSearchOptions options_;
  TagDetector detector_;
  int since_whole_ = 0;
  int without_tags_ = 0;  // pictures in a row
  bool whole_ = false, mirrored_ = false;
};

}  // namespace slamscope::tracking
