// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "engine/scene/glyphs.hpp"

namespace slamscope::apps {

/// The colours of what is drawn, by role.
struct Palette {
  engine::Rgba robot, heading, feature, tentative;
  engine::Rgba pair, ellipsoid;                      ///< line and relative covariance
  engine::Rgba tentative_pair, tentative_ellipsoid;  ///< of pairs with a tentative feature
  /// What the audit flags (spec visualisation.md, "Flags"). A halo shows through the ellipsoid.
  engine::Rgba flagged, flagged_pair, flagged_ellipsoid, halo, halo_ring;
  engine::Rgba own_error;   ///< the registration's, around each feature
  engine::Rgba alarm_text;  ///< of `flagged` what reads on a dark panel
};

enum class PaletteName {
  paper,  ///< section 3.2 of the paper; flags are magenta
  safe,   ///< apart for the colour-blind too: Okabe and Ito's (2008) colours, and white
};

[[nodiscard]] const Palette& paletteOf(PaletteName name);

/// `paper`, `safe`. The second throws std::invalid_argument on others.
[[nodiscard]] std::string_view paletteName(PaletteName name);
[[nodiscard]] PaletteName paletteFromName(std::string_view name);

}  // namespace slamscope::apps
