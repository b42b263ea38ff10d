// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/lib/view/scene_builder.hpp"
#include "engine/scene/font_atlas.hpp"
#include "engine/scene/glyphs.hpp"
#include "engine/scene/view.hpp"

namespace slamscope::apps {

/// What the legend says of the glyphs and their scale.
struct Legend {
  slam::PairMode mode = slam::PairMode::all;
  slam::AxisScale axis;
  PaletteName palette = PaletteName::paper;
  double map_scale = 1.0;
  bool covariance_rings = false;
  bool own_error = false;    ///< the registration's, at each feature
  bool tentative = false;    ///< some features are
  int clusters = 0;          ///< 0: not shown
  double cluster_cut = 0.0;  ///< m
  bool automatic_cut = true;
  PairThinning thinning;
  bool lines_left_out = false;  ///< there are too many pairs for a line each
  bool flagged = false;         ///< something is, or could be, drawn as flagged by the audit
  double px_per_m = 0.0;        ///< of the scene at the middle of the map; 0: no scale bar
};

/// Puts lines of text on a dark panel in the picture's upper left corner.
void addStatus(engine::Scene& scene, const std::vector<std::string>& lines,
               const engine::Pinhole& camera, engine::FontAtlas& fonts);

/// A line of what the audit says.
struct AlarmLine {
  explicit AlarmLine(std::string_view said, bool is_alarm = false) : text(said), alarm(is_alarm) {}

  std::string text;
  bool alarm = false;  ///< in the colour of what the audit flags
};

/// The same in the lower right corner, alarms in the palette's colour for them. Where there is no
/// room beside other panels only the first kFewAlarms lines, above them. Nothing for no lines.
inline constexpr std::size_t kFewAlarms = 2;
void addAlarms(engine::Scene& scene, std::vector<AlarmLine> lines, PaletteName palette,
               const engine::Pinhole& camera, engine::FontAtlas& fonts);

/// Puts the legend into the picture's lower left corner: what each glyph is, how long its axes are,
/// and a bar of a round length with what it stands for.
void addLegend(engine::Scene& scene, const Legend& legend, const engine::Pinhole& camera,
               engine::FontAtlas& fonts);

/// Eigenvalue (m²) whose semi-axis is drawn `length` m long: the inverse of AxisScale::semiAxis.
[[nodiscard]] double eigenvalueOfLength(const slam::AxisScale& axis, double length);

/// The largest of 1, 2, 5 × 10^k that is not above `length` (> 0).
[[nodiscard]] double roundLength(double length);

}  // namespace slamscope::apps
