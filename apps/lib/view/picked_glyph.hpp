// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/scene/glyphs.hpp"
#include "engine/scene/view.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::apps {

/// What of a scene that shows `snapshot` is at a pixel of a view (OpenCV's convention), in a line
/// for people: "feature 12: 3.1 cm × 1.2 cm (1σ)" where its cone's tip is within a few pixels, else
/// the pair of features whose ellipsoid is seen there, else that there is nothing.
[[nodiscard]] std::string whatIsAt(const Eigen::Vector2d& pixel, const engine::Scene& scene,
                                   const slam::Snapshot& snapshot, const engine::View& view,
                                   double map_scale);

}  // namespace slamscope::apps
