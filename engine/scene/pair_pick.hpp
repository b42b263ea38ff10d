// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "engine/scene/pair_glyphs.hpp"
#include "engine/scene/view.hpp"

namespace slamscope::engine {

/// P_d = P_ii + P_jj − P_ij − P_ji of two points (m²), from what the device gets of them.
[[nodiscard]] Eigen::Matrix2d differenceCovariance(const PlanarPoints& points, std::uint32_t i,
                                                   std::uint32_t j);

/// The ellipsoid that stands for two points in the scene, as the device makes it but in double
/// precision.
[[nodiscard]] Ellipsoid pairEllipsoid(const PairGlyphs& glyphs, std::uint32_t i, std::uint32_t j);

/// Points i < j.
struct PickedPair {
  std::uint32_t i = 0, j = 0;
  double depth = 0.0;  ///< z in the eye, m
};

/// The pair whose ellipsoid is seen at a pixel (OpenCV's convention): of the chosen ones that the
/// pixel's ray meets the nearest, none where it meets none. The same whichever way they are drawn.
/// Goes over all pairs: a tenth of a second for half a million, for a click and not for a frame.
[[nodiscard]] std::optional<PickedPair> pickPair(const PairGlyphs& glyphs, const View& view,
                                                 const Eigen::Vector2d& pixel);

}  // namespace slamscope::engine
