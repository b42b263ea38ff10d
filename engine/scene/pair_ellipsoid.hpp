// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/scene/pair_glyphs.hpp"

namespace slamscope::engine {

/// P_d = P_ii + P_jj − P_ij − P_ji of two points (m²), from what the device gets of them.
[[nodiscard]] Eigen::Matrix2d differenceCovariance(const PlanarPoints& points, std::uint32_t i,
                                                   std::uint32_t j);

/// The ellipsoid that stands for two points in the scene, as the device makes it but in double
/// precision.
[[nodiscard]] Ellipsoid pairEllipsoid(const PairGlyphs& glyphs, std::uint32_t i, std::uint32_t j);

}  // namespace slamscope::engine
