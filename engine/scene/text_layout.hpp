// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "engine/scene/font_atlas.hpp"

namespace slamscope::engine {

/// One glyph to draw: a rectangle of the picture and the texels that fill it, one to one. Draw at a
/// whole-pixel origin and fetch texels without filtering.
struct GlyphQuad {
  Eigen::Vector2f min_px, max_px;  ///< from the text's upper left corner, right and down; whole
  Eigen::Vector2f min_uv, max_uv;  ///< texels (not divided by the atlas's size); whole
};

/// Size of a text's box, halo not counted.
struct TextExtent {
  double width_px = 0.0, height_px = 0.0;
  int lines = 0;  ///< at least 1, except for the empty text
};

/// Quads of a UTF-8 text from its upper left corner at (0, 0); '\n' starts a new line. Blanks make
/// no quad; bytes that are no UTF-8 show as U+FFFD. Overlapping quads of neighbours are meant to be
/// drawn all halos first, then all glyphs. May add glyphs to the atlas (its revision changes).
[[nodiscard]] std::vector<GlyphQuad> layoutText(FontAtlas& atlas, std::string_view utf8,
                                                double height_px);

/// The box that layoutText fills, for panels behind a text.
[[nodiscard]] TextExtent measureText(FontAtlas& atlas, std::string_view utf8, double height_px);

}  // namespace slamscope::engine
