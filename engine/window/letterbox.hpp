// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

namespace slamscope::engine {

/// Where in a window the picture stands: as large as fits, its shape kept, in the middle; whole
/// pixels. Views stand side by side in it. All lengths in px, right and down.
struct Letterbox {
  Eigen::Vector2i corner_px = Eigen::Vector2i::Zero();  ///< upper left, in the window
  Eigen::Vector2i size_px = Eigen::Vector2i::Zero();    ///< of all views together
  /// True where one pixel of the picture is one of the window.
  bool exact = false;
};

/// `picture_px` is the size of one view. Throws std::invalid_argument where a size or the number of
/// views is not positive.
[[nodiscard]] Letterbox letterbox(const Eigen::Vector2i& picture_px, int views,
                                  const Eigen::Vector2i& window_px);

/// A place in a view.
struct PicturePoint {
  Eigen::Vector2d px = Eigen::Vector2d::Zero();  ///< OpenCV's convention
  int view = 0;
};

/// The place of the picture that is seen at `window_point` (0 = the window's left or upper edge);
/// none in the border.
[[nodiscard]] std::optional<PicturePoint> pictureAt(const Letterbox& box,
                                                    const Eigen::Vector2i& picture_px, int views,
                                                    const Eigen::Vector2d& window_point);

}  // namespace slamscope::engine
