// SPDX-License-Identifier: MIT
#include "apps/lib/view/palette.hpp"

#include <stdexcept>
#include <string>

namespace slamscope::apps {
namespace {

using engine::Rgba;

constexpr Rgba withOpacity(Rgba colour, float opacity) {
  colour.a = opacity;
  return colour;
}

constexpr Rgba lighter(const Rgba& colour, float share, float opacity) {
  return {colour.r + share * (1.0F - colour.r), colour.g + share * (1.0F - colour.g),
          colour.b + share * (1.0F - colour.b), opacity};
}

/// The hues that everything else follows from.
struct Hues {
  Rgba robot, heading, feature, tentative, pair, ellipsoid, flagged;
};

constexpr Palette paletteFrom(const Hues& hues) {
  return {.robot = hues.robot,
          .heading = hues.heading,
          .feature = hues.feature,
          .tentative = withOpacity(hues.tentative, 0.55F),
          .pair = withOpacity(hues.pair, 0.60F),
          .ellipsoid = hues.ellipsoid,
          .tentative_pair = withOpacity(hues.pair, 0.25F),
          .tentative_ellipsoid = withOpacity(hues.ellipsoid, 0.35F),
          .flagged = hues.flagged,
          .flagged_pair = withOpacity(hues.flagged, 0.60F),
          .flagged_ellipsoid = withOpacity(hues.flagged, 0.60F),
          .halo = lighter(hues.flagged, 0.62F, 0.38F),
          .halo_ring = lighter(hues.flagged, 0.74F, 0.55F),
          .own_error = {1.0F, 1.0F, 1.0F, 0.9F},
          .alarm_text = lighter(hues.flagged, 0.55F, 1.0F)};
}

constexpr Palette kPaper = paletteFrom({.robot = {0.12F, 0.80F, 0.22F},
                                        .heading = {1.00F, 0.84F, 0.05F},
                                        .feature = {0.05F, 0.85F, 0.95F},
                                        .tentative = {0.72F, 0.80F, 0.82F},
                                        .pair = {1.00F, 0.90F, 0.10F},
                                        .ellipsoid = {0.90F, 0.12F, 0.10F},
                                        .flagged = {0.96F, 0.05F, 0.86F}});

// Okabe and Ito, "Color Universal Design" (2008): blue, yellow, sky blue, vermillion, reddish
// purple. White is ours: their black would not be seen on a dark floor.
constexpr Rgba kYellow{0xF0 / 255.0F, 0xE4 / 255.0F, 0x42 / 255.0F};
constexpr Palette kSafe = paletteFrom({.robot = {0x00 / 255.0F, 0x72 / 255.0F, 0xB2 / 255.0F},
                                       .heading = kYellow,
                                       .feature = {0x56 / 255.0F, 0xB4 / 255.0F, 0xE9 / 255.0F},
                                       .tentative = {1.0F, 1.0F, 1.0F},
                                       .pair = kYellow,
                                       .ellipsoid = {0xD5 / 255.0F, 0x5E / 255.0F, 0x00 / 255.0F},
                                       .flagged = {0xCC / 255.0F, 0x79 / 255.0F, 0xA7 / 255.0F}});

}  // namespace

const Palette& paletteOf(PaletteName name) {
  return name == PaletteName::safe ? kSafe : kPaper;
}

std::string_view paletteName(PaletteName name) {
  return name == PaletteName::safe ? "safe" : "paper";
}

PaletteName paletteFromName(std::string_view name) {
  for (const PaletteName known : {PaletteName::paper, PaletteName::safe}) {
    if (paletteName(known) == name) return known;
  }
  throw std::invalid_argument("no palette of the name '" + std::string(name) +
                              "'; known: paper, safe");
}

}  // namespace slamscope::apps
