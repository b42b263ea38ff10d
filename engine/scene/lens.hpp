// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace slamscope::engine {

/// Lens between the display and one eye, allowed for beforehand: at distance r of the display from
/// `centre` the picture's point at r (1 + k1 r² + k2 r⁴ + k3 r⁶) · scale is shown, black where the
/// picture ends. r in half heights of the picture.
struct Lens {
  Eigen::Vector2d centre{0.5, 0.5};  ///< parts of width and height from the upper left
  Eigen::Vector3d k = Eigen::Vector3d::Zero();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< red, green, blue

  /// Shows the picture as it is, to the byte.
  [[nodiscard]] bool plain() const { return k.isZero(0.0) && scale == Eigen::Vector3d::Ones(); }
};

/// Where in the drawn picture (OpenCV's convention) a pixel of the one seen through the lens comes
/// from; of the three colours' places that of green.
[[nodiscard]] Eigen::Vector2d drawnPixel(const Lens& lens, const Eigen::Vector2d& size_px,
                                         const Eigen::Vector2d& shown);

}  // namespace slamscope::engine
