// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "engine/scene/font_atlas.hpp"
#include "engine/scene/text_layout.hpp"

using namespace slamscope::engine;

namespace {

struct Texel {
  int fill, halo;
};

Texel texelAt(const FontAtlas& atlas, int u, int v) {
  const std::size_t at = 2 * (static_cast<std::size_t>(v) * atlas.width() + u);
  return {atlas.pixels()[at], atlas.pixels()[at + 1]};
}

// Fill down the column through the left half of a glyph's bar.
std::vector<int> columnThroughBar(const FontAtlas& atlas, const AtlasGlyph& glyph) {
  std::vector<int> column;
  for (int y = 0; y < glyph.height; ++y) {
    column.push_back(texelAt(atlas, glyph.u + FontAtlas::kHaloPx + 2, glyph.v + y).fill);
  }
  return column;
}

// A crisp bar goes from nothing to (nearly) full within a pixel on its upper side.
bool startsCrisply(const std::vector<int>& column) {
  const auto first = std::find_if(column.begin(), column.end(), [](int fill) { return fill > 25; });
  return first != column.end() && *first > 200;
}

}  // namespace

TEST(FontAtlas, HoldsEveryCharacterOfLegendsAndStatusLines) {
  FontAtlas atlas;
  const AtlasGlyph missing = atlas.glyph(0xE000, 14);  // private use: the font has none
  std::u32string wanted = U"σθλ√·×−°±≤≥→↑…–µ²Σλ";
  for (char32_t c = 0x21; c < 0x7F; ++c) wanted += c;
  for (char32_t c = 0xA1; c < 0x100; ++c) {
    if (c != 0xAD) wanted += c;  // the soft hyphen is invisible by right
  }
  for (const char32_t c : wanted) {
    const AtlasGlyph& glyph = atlas.glyph(c, 14);
    EXPECT_GT(glyph.width, 0) << "U+" << std::hex << static_cast<unsigned>(c);
    bool same = glyph.width == missing.width && glyph.height == missing.height;
    for (int y = 0; same && y < glyph.height; ++y) {
      for (int x = 0; same && x < glyph.width; ++x) {
        same = texelAt(atlas, glyph.u + x, glyph.v + y).fill ==
               texelAt(atlas, missing.u + x, missing.v + y).fill;
      }
    }
    EXPECT_FALSE(same) << "U+" << std::hex << static_cast<unsigned>(c) << " is the missing box";
  }
}

TEST(FontAtlas, HaloCoversTheGlyphAndReachesTwoPixelsPastIt) {
  FontAtlas atlas;
  const AtlasGlyph glyph = atlas.glyph(U'I', 16);
  int left = glyph.width;
  int halo_left = glyph.width;
  for (int y = 0; y < glyph.height; ++y) {
    for (int x = 0; x < glyph.width; ++x) {
      const Texel texel = texelAt(atlas, glyph.u + x, glyph.v + y);
      EXPECT_GE(texel.halo, texel.fill);
      if (texel.fill > 100) left = std::min(left, x);
      if (texel.halo > 40) halo_left = std::min(halo_left, x);
    }
  }
  EXPECT_EQ(left - halo_left, FontAtlas::kHaloPx);
}

TEST(FontAtlas, BarsOfSmallTextStartOnWholePixels) {
  FontAtlas atlas;
  for (const int size : {13, 14, 15, 16}) {
    EXPECT_TRUE(startsCrisply(columnThroughBar(atlas, atlas.glyph(U'T', size)))) << size << " px";
  }
  EXPECT_FALSE(startsCrisply({0, 0, 120, 255, 120, 0}));  // twin: a bar between two pixels
}

TEST(FontAtlas, GlyphsDoNotOverlapAndStayInPlaceWhileTheAtlasGrows) {
  FontAtlas atlas;
  const int first_height = atlas.height();
  const AtlasGlyph early = atlas.glyph(U'Q', 20);
  std::vector<int> texels;
  for (int x = 0; x < early.width; ++x)
    texels.push_back(texelAt(atlas, early.u + x, early.v + 8).fill);
  std::vector<AtlasGlyph> glyphs{early};
  for (int size = 11; size <= 40; ++size) {
    if (size == 20) continue;
    for (char32_t c = 'a'; c <= 'z'; ++c) glyphs.push_back(atlas.glyph(c, size));
  }
  EXPECT_GT(atlas.height(), first_height);
  EXPECT_EQ(atlas.pixels().size(), 2u * atlas.width() * atlas.height());
  EXPECT_EQ(atlas.glyph(U'Q', 20).u, early.u);
  for (int x = 0; x < early.width; ++x) {
    EXPECT_EQ(texels[x], texelAt(atlas, early.u + x, early.v + 8).fill);
  }
  std::vector<char> owned(static_cast<std::size_t>(atlas.width()) * atlas.height());
  for (const AtlasGlyph& glyph : glyphs) {
    for (int y = 0; y < glyph.height; ++y) {
      for (int x = 0; x < glyph.width; ++x) {
        char& taken = owned.at(static_cast<std::size_t>(glyph.v + y) * atlas.width() + glyph.u + x);
        ASSERT_EQ(taken, 0);
        taken = 1;
      }
    }
  }
}

TEST(FontAtlas, RevisionChangesOnlyWhenTexelsWereAdded) {
  FontAtlas atlas;
  (void)atlas.glyph(U'a', 14);
  const auto revision = atlas.revision();
  (void)atlas.glyph(U'a', 14);
  (void)atlas.glyph(U' ', 14);
  EXPECT_EQ(atlas.revision(), revision);
  (void)atlas.glyph(U'a', 15);
  EXPECT_NE(atlas.revision(), revision);
}

TEST(FontAtlas, SizesAreWholePixelsWithinBounds) {
  EXPECT_EQ(FontAtlas::sizeFor(13.4), 13);
  EXPECT_EQ(FontAtlas::sizeFor(1.0), FontAtlas::kLeastSizePx);
  EXPECT_EQ(FontAtlas::sizeFor(1e9), FontAtlas::kMostSizePx);
  EXPECT_THROW((void)FontAtlas::sizeFor(std::numeric_limits<double>::quiet_NaN()),
               std::invalid_argument);
}

TEST(TextLayout, QuadsHaveOneTexelPerWholePixel) {
  FontAtlas atlas;
  for (const GlyphQuad& quad : layoutText(atlas, "P_d: 3σ, λ ≤ 0.2 m²\nfade → 50 %", 13.6)) {
    EXPECT_EQ(quad.max_px - quad.min_px, quad.max_uv - quad.min_uv);
    for (const auto& corner : {quad.min_px, quad.max_px, quad.min_uv, quad.max_uv}) {
      EXPECT_EQ(corner, corner.array().round().matrix());
    }
  }
}

TEST(TextLayout, LinesFollowEachOtherDownAndTheExtentHoldsThem) {
  FontAtlas atlas;
  const TextExtent one = measureText(atlas, "status", 14);
  const TextExtent three = measureText(atlas, "status\n\nstatus and more", 14);
  EXPECT_EQ(one.lines, 1);
  EXPECT_EQ(three.lines, 3);
  EXPECT_EQ(three.height_px, 3 * one.height_px);
  EXPECT_GT(three.width_px, one.width_px);
  EXPECT_GT(one.height_px, 14.0);
  const auto quads = layoutText(atlas, "status\nstatus", 14);
  ASSERT_EQ(quads.size(), 12u);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(quads[i + 6].min_px - quads[i].min_px, Eigen::Vector2f(0, one.height_px));
  }
  for (const GlyphQuad& quad : layoutText(atlas, "Hg_|j", 14)) {
    const float halo = FontAtlas::kHaloPx;
    EXPECT_GE(quad.min_px.y(), -halo);
    EXPECT_LE(quad.max_px.y(), measureText(atlas, "Hg_|j", 14).height_px + halo);
  }
}

TEST(TextLayout, DigitsAreOfOneWidthSoThatNumbersDoNotWobble) {
  FontAtlas atlas;
  const double width = measureText(atlas, "0000", 14).width_px;
  for (char digit = '1'; digit <= '9'; ++digit) {
    EXPECT_EQ(measureText(atlas, std::string(4, digit), 14).width_px, width);
  }
  EXPECT_NE(measureText(atlas, "iiii", 14).width_px, width);  // letters differ: the check can fail
}

TEST(TextLayout, EmptyTextHasNoExtent) {
  FontAtlas atlas;
  const TextExtent extent = measureText(atlas, "", 14);
  EXPECT_EQ(extent.lines, 0);
  EXPECT_EQ(extent.width_px, 0.0);
  EXPECT_TRUE(layoutText(atlas, "", 14).empty());
  EXPECT_TRUE(layoutText(atlas, "  \n ", 14).empty());
}

TEST(TextLayout, BytesThatAreNoUtf8ShowAsReplacementCharacters) {
  FontAtlas atlas;
  const double replacement = measureText(atlas, "\xEF\xBF\xBD", 14).width_px;
  const double a = measureText(atlas, "a", 14).width_px;
  EXPECT_EQ(measureText(atlas, "a\xFF", 14).width_px, a + replacement);
  EXPECT_EQ(measureText(atlas, "\xC3", 14).width_px, replacement);              // cut short
  EXPECT_EQ(measureText(atlas, "\xC0\x80", 14).width_px, 2 * replacement);      // over-long
  EXPECT_EQ(measureText(atlas, "\xED\xA0\x80", 14).width_px, 3 * replacement);  // surrogate
  EXPECT_NE(measureText(atlas, "\xC3\xA9", 14).width_px, replacement);          // é is fine
}
