// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>

#include "engine/scene/view.hpp"

namespace slamscope::apps {

/// How two eyes share one picture.
enum class EyeLayout {
  side_by_side,       ///< 2W × H, the left eye at x = 0
  half_side_by_side,  ///< W × H, each eye half as wide (pairs of columns averaged)
  top_bottom,         ///< W × 2H, the left eye above
  anaglyph  ///< W × H: red of the left eye, green and blue of the right; red-cyan glasses
};

/// `side-by-side`, `half-side-by-side`, `top-bottom`, `anaglyph`; std::invalid_argument otherwise.
[[nodiscard]] EyeLayout eyeLayoutFromName(const std::string& name);

/// Puts two pictures of one size into one. Throws std::invalid_argument for different sizes, or an
/// odd width with half_side_by_side.
void layOut(EyeLayout layout, const engine::Image& left, const engine::Image& right,
            engine::Image& both);

/// Which of the two pictures a pixel of both shows, and where. Of an anaglyph, which shows both at
/// the same place, the left one.
struct EyePixel {
  int eye = 0;  ///< 0: the one laid out as the left
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};
[[nodiscard]] EyePixel eyePixel(EyeLayout layout, const Eigen::Vector2i& eye_size,
                                const Eigen::Vector2d& pixel);

}  // namespace slamscope::apps
