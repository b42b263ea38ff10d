// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>

namespace slamscope::engine {

/// Where one glyph lies in the atlas, and how it stands on its line. All in whole pixels.
struct AtlasGlyph {
  int advance_px = 0;         ///< from this pen position to the next
  int left_px = 0;            ///< from the pen to the box's left edge, right positive
  int top_px = 0;             ///< from the baseline to the box's upper edge, down positive
  int u = 0, v = 0;           ///< upper left texel of the box
  int width = 0, height = 0;  ///< of the box, halo included; 0 for blanks
};

/// Vertical measures of a line of text.
struct LineMetrics {
  int ascent_px = 0;   ///< from the line's upper edge to the baseline
  int descent_px = 0;  ///< from the baseline to the line's lower edge
  /// From one baseline to the next.
  [[nodiscard]] int height_px() const { return ascent_px + descent_px; }
};

/// DejaVu Sans, rasterised on demand at the exact size that is asked for: one texel is one pixel,
/// so that small text is crisp. The font is part of the program: no file is read. Texels are two
/// bytes: R = coverage of the glyph, G = coverage of its halo (the glyph grown by kHaloPx), to be
/// drawn dark underneath. The atlas keeps its width and grows downwards, so texel coordinates that
/// were handed out stay right for good; upload again when `revision()` changed.
class FontAtlas {
 public:
  static constexpr int kHaloPx = 2;       ///< how far the halo reaches past the glyph
  static constexpr int kLeastSizePx = 8;  ///< sizes are rounded and held to [8, 96]
  static constexpr int kMostSizePx = 96;

  /// Throws std::runtime_error where FreeType can't read the font.
  FontAtlas();
  ~FontAtlas();
  FontAtlas(FontAtlas&&) noexcept;
  FontAtlas& operator=(FontAtlas&&) noexcept;

  [[nodiscard]] int width() const;
  [[nodiscard]] int height() const;
  /// Rows of width() × height() texels, two bytes each (R, G), tightly packed.
  [[nodiscard]] std::span<const std::uint8_t> pixels() const;
  /// Grows each time texels were added.
  [[nodiscard]] std::uint64_t revision() const;

  /// The whole-pixel font size (em) that stands for `height_px`.
  [[nodiscard]] static int sizeFor(double height_px);

  /// Rasterises the glyph where it isn't in the atlas yet; a code point the font lacks gives its
  /// "missing" box. `size_px` as from sizeFor(). The reference stays valid until the atlas dies.
  [[nodiscard]] const AtlasGlyph& glyph(char32_t code_point, int size_px);
  [[nodiscard]] LineMetrics lineMetrics(int size_px);

 private:
  struct Face;
  std::unique_ptr<Face> face_;
};

}  // namespace slamscope::engine
