// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/font_atlas.hpp"
#include "engine/scene/glyphs.hpp"
#include "engine/scene/view.hpp"

namespace slamscope::apps {

/// Puts feature labels where they cover neither their cones nor each other; those without a free
/// place are left out, and of very many those farthest from the viewer, whose labels fade.
void spreadLabels(engine::Scene& scene, const engine::View& view, engine::FontAtlas& fonts);

}  // namespace slamscope::apps
