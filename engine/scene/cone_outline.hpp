// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "engine/scene/ellipsoid_outline.hpp"
#include "engine/scene/glyphs.hpp"
#include "engine/scene/view.hpp"

namespace slamscope::engine {

/// Exact picture of an upright cone: the hull of its tip and its rim's ellipse. px, OpenCV's
/// convention.
struct ConeOutline {
  Eigen::Vector2d tip_px = Eigen::Vector2d::Zero();
  /// Where the two silhouette edges (straight, from the tip) touch the rim, the smaller u first.
  std::array<Eigen::Vector2d, 2> edge_px;
  OutlineEllipse rim;
};

/// None where the cone is not wholly in front of the eye, or where the tip's picture lies inside
/// the rim's (seen from straight above: no edges).
[[nodiscard]] std::optional<ConeOutline> coneOutline(const Cone& cone, const View& view);

}  // namespace slamscope::engine
