// SPDX-License-Identifier: MIT
#include "engine/scene/text_layout.hpp"

#include <algorithm>

namespace slamscope::engine {
namespace {

constexpr char32_t kReplacement = 0xFFFD;

// Bytes of the sequence that a lead byte starts; 0 for a byte that starts none.
std::size_t sequenceLength(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead < 0xC2) return 0;
  if (lead < 0xE0) return 2;
  if (lead < 0xF0) return 3;
  return lead < 0xF5 ? 4 : 0;
}

// Next code point, eating its bytes; bytes that are no UTF-8 give U+FFFD, one byte each.
char32_t nextCodePoint(std::string_view& text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t length = sequenceLength(lead);
  char32_t code_point = length <= 1 ? lead : lead & (0x7F >> length);
  bool good = length > 0 && length <= text.size();
  for (std::size_t i = 1; good && i < length; ++i) {
    const auto next = static_cast<unsigned char>(text[i]);
    good = (next & 0xC0) == 0x80;
    code_point = (code_point << 6) | (next & 0x3F);
  }
  // Over-long forms, surrogates and what lies past Unicode are no characters.
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  good = good && code_point >= kLeast[length] && code_point <= 0x10FFFF &&
         (code_point < 0xD800 || code_point > 0xDFFF);
  text.remove_prefix(good ? length : 1);
  return good ? code_point : kReplacement;
}

struct PlacedGlyph {
  const AtlasGlyph* glyph;
  int x, baseline;
};

// Walks the text once; both public functions see the same pen.
template <typename OnGlyph>
TextExtent walk(FontAtlas& atlas, std::string_view text, double height_px, OnGlyph&& on_glyph) {
  if (text.empty()) return {};
  const int size_px = FontAtlas::sizeFor(height_px);
  const LineMetrics line = atlas.lineMetrics(size_px);
  int x = 0;
  int widest = 0;
  int lines = 1;
  while (!text.empty()) {
    const char32_t code_point = nextCodePoint(text);
    if (code_point == U'\n') {
      ++lines;
      x = 0;
      continue;
    }
    const AtlasGlyph& glyph = atlas.glyph(code_point, size_px);
    on_glyph(PlacedGlyph{&glyph, x, (lines - 1) * line.height_px() + line.ascent_px});
    x += glyph.advance_px;
    widest = std::max(widest, x);
  }
  return {double(widest), double(lines * line.height_px()), lines};
}

}  // namespace

std::vector<GlyphQuad> layoutText(FontAtlas& atlas, std::string_view utf8, double height_px) {
  std::vector<GlyphQuad> quads;
  quads.reserve(utf8.size());
  walk(atlas, utf8, height_px, [&quads](const PlacedGlyph& placed) {
    const AtlasGlyph& glyph = *placed.glyph;
    if (glyph.width == 0) return;
    const Eigen::Vector2f corner =
        Eigen::Vector2i(placed.x + glyph.left_px, placed.baseline + glyph.top_px).cast<float>();
    const Eigen::Vector2f texel = Eigen::Vector2i(glyph.u, glyph.v).cast<float>();
    const Eigen::Vector2f size = Eigen::Vector2i(glyph.width, glyph.height).cast<float>();
    quads.push_back({corner, corner + size, texel, texel + size});
  });
  return quads;
}

TextExtent measureText(FontAtlas& atlas, std::string_view utf8, double height_px) {
  return walk(atlas, utf8, height_px, [](const PlacedGlyph&) {});
}

}  // namespace slamscope::engine
