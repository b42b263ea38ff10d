// SPDX-License-Identifier: MIT
#include "engine/scene/font_atlas.hpp"

#include <ft2build.h>

#include "engine/scene/font_bytes.hpp"
#include FT_FREETYPE_H

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace slamscope::engine {
namespace {

constexpr int kWidth = 1024;
constexpr int kFirstHeight = 128;

void check(FT_Error error, const char* what) {
  if (error != 0) {
    throw std::runtime_error(std::string("the built-in font: ") + what +
                             " failed (FreeType error " + std::to_string(error) + ")");
  }
}

// How dark the halo is at a distance from a covered pixel: full next to it, then fading.
float haloWeight(int dx, int dy) {
  const float distance = std::hypot(static_cast<float>(dx), static_cast<float>(dy));
  return std::clamp(0.5F + FontAtlas::kHaloPx - distance, 0.0F, 1.0F);
}

// Coverage grown by kHaloPx in all directions.
void spreadHalo(const std::vector<std::uint8_t>& fill, int width, int height,
                std::vector<std::uint8_t>& halo) {
  constexpr int r = FontAtlas::kHaloPx;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      float most = 0.0F;
      for (int v = std::max(0, y - r); v <= std::min(height - 1, y + r); ++v) {
        for (int u = std::max(0, x - r); u <= std::min(width - 1, x + r); ++u) {
          most = std::max(most, haloWeight(u - x, v - y) * static_cast<float>(fill[v * width + u]));
        }
      }
      halo[y * width + x] = static_cast<std::uint8_t>(std::lround(most));
    }
  }
}

}  // namespace

struct FontAtlas::Face {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  int size_px = 0;
  int height = kFirstHeight;
  std::vector<std::uint8_t> pixels = std::vector<std::uint8_t>(2 * kWidth * kFirstHeight);
  std::uint64_t revision = 0;
  // Shelf packing: glyphs stand side by side on the current shelf.
  int shelf_u = 0, shelf_v = 0, shelf_height = 0;
  std::map<std::pair<int, char32_t>, AtlasGlyph> glyphs;

  Face() {
    check(FT_Init_FreeType(&library), "start");
    const auto bytes = fontBytes();
    const FT_Error error =
        FT_New_Memory_Face(library, bytes.data(), static_cast<FT_Long>(bytes.size()), 0, &face);
    if (error != 0) {
      FT_Done_FreeType(library);
      check(error, "reading");
    }
  }
  ~Face() {
    FT_Done_Face(face);
    FT_Done_FreeType(library);
  }
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;

  void useSize(int px) {
    if (px != size_px) {
      check(FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(px)), "choosing a size");
      size_px = px;
    }
  }

  // Reserves a box, with an empty texel around so that a filtered fetch would not bleed either.
  std::pair<int, int> reserve(int box_width, int box_height) {
    if (shelf_u + box_width + 1 > kWidth) {
      shelf_v += shelf_height;
      shelf_u = 0;
      shelf_height = 0;
    }
    const std::pair<int, int> corner{shelf_u, shelf_v};
    shelf_u += box_width + 1;
    shelf_height = std::max(shelf_height, box_height + 1);
    while (shelf_v + shelf_height > height) height *= 2;
    pixels.resize(static_cast<std::size_t>(2) * kWidth * height);
    return corner;
  }

  AtlasGlyph rasterise(char32_t code_point, int px) {
    useSize(px);
    // Light hinting snaps to whole pixels vertically only: crisp bars, unchanged shapes.
    check(FT_Load_Char(face, code_point, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT), "drawing a glyph");
    const FT_GlyphSlot slot = face->glyph;
    const FT_Bitmap& bitmap = slot->bitmap;
    AtlasGlyph glyph;
    glyph.advance_px = static_cast<int>((slot->advance.x + 32) >> 6);
    if (bitmap.width == 0 || bitmap.rows == 0) return glyph;

    glyph.width = static_cast<int>(bitmap.width) + 2 * kHaloPx;
    glyph.height = static_cast<int>(bitmap.rows) + 2 * kHaloPx;
    glyph.left_px = slot->bitmap_left - kHaloPx;
    glyph.top_px = -slot->bitmap_top - kHaloPx;
    std::vector<std::uint8_t> fill(static_cast<std::size_t>(glyph.width) * glyph.height);
    for (int row = 0; row < static_cast<int>(bitmap.rows); ++row) {
      std::copy_n(bitmap.buffer + static_cast<std::ptrdiff_t>(row) * bitmap.pitch, bitmap.width,
                  &fill[(row + kHaloPx) * glyph.width + kHaloPx]);
    }
    std::vector<std::uint8_t> halo(fill.size());
    spreadHalo(fill, glyph.width, glyph.height, halo);

    std::tie(glyph.u, glyph.v) = reserve(glyph.width, glyph.height);
    for (int y = 0; y < glyph.height; ++y) {
      for (int x = 0; x < glyph.width; ++x) {
        const std::size_t texel =
            2 * ((glyph.v + y) * static_cast<std::size_t>(kWidth) + glyph.u + x);
        pixels[texel] = fill[y * glyph.width + x];
        pixels[texel + 1] = halo[y * glyph.width + x];
      }
    }
    ++revision;
    return glyph;
  }
};

FontAtlas::FontAtlas() : face_(std::make_unique<Face>()) {}
FontAtlas::~FontAtlas() = default;
FontAtlas::FontAtlas(FontAtlas&&) noexcept = default;
FontAtlas& FontAtlas::operator=(FontAtlas&&) noexcept = default;

int FontAtlas::width() const {
  return kWidth;
}
int FontAtlas::height() const {
  return face_->height;
}
std::span<const std::uint8_t> FontAtlas::pixels() const {
  return face_->pixels;
}
std::uint64_t FontAtlas::revision() const {
  return face_->revision;
}

int FontAtlas::sizeFor(double height_px) {
  if (!std::isfinite(height_px)) {
    throw std::invalid_argument("a text's height must be a finite number of pixels");
  }
  return static_cast<int>(
      std::lround(std::clamp(height_px, double{kLeastSizePx}, double{kMostSizePx})));
}

const AtlasGlyph& FontAtlas::glyph(char32_t code_point, int size_px) {
  const std::pair key{size_px, code_point};
  const auto found = face_->glyphs.find(key);
  if (found != face_->glyphs.end()) return found->second;
  return face_->glyphs.emplace(key, face_->rasterise(code_point, size_px)).first->second;
}

LineMetrics FontAtlas::lineMetrics(int size_px) {
  face_->useSize(size_px);
  const FT_Size_Metrics& metrics = face_->face->size->metrics;
  return {static_cast<int>((metrics.ascender + 63) >> 6),
          static_cast<int>((-metrics.descender + 63) >> 6)};
}

}  // namespace slamscope::engine
