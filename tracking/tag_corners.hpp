// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "tracking/camera_model.hpp"
#include "tracking/image_view.hpp"

namespace slamscope::tracking {

/// Corners of a square from the grey profiles of its four sides.
struct RefinedCorners {
  std::array<Eigen::Vector2d, 4> px;  ///< OpenCV's convention
  std::array<double, 4> sigma_px{};   ///< per axis
  double blur_px = 0, contrast = 0;   ///< mean over the sides: standard deviation; grey levels
};

struct CornerRefinement {
  int cells = 8;  ///< of the tag's grid across the square: nothing but the edge within one cell
  double least_side_px = 20;            ///< smaller ones are better left alone (measured)
  const CameraModel* camera = nullptr;  ///< given: sides bow as its lens bends them
};

/// Moves corners that are a pixel or so off to where the sides of the square meet. To the pixels
/// along each side a straight edge is fitted: step · blur, the step seen through square pixels,
/// with its own grey levels on both sides (they may change along the side), blur, offset and slope,
/// robustly; the half-crossing of that profile is the side. No interpolation between pixels takes
/// part, so there is no bias on edges that run along rows or columns. Nothing where the square is
/// too small, too faint, at the picture's border, or where a side doesn't look like one.
[[nodiscard]] std::optional<RefinedCorners> refineCorners(
    const ImageView& grey, const std::array<Eigen::Vector2d, 4>& start_px,
    const CornerRefinement& options);

}  // namespace slamscope::tracking
