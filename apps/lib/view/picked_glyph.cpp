// SPDX-License-Identifier: MIT
#include "apps/lib/view/picked_glyph.hpp"

#include <algorithm>
#include <cstdio>

#include "apps/lib/view/glyph_meaning.hpp"
#include "slam/correlation.hpp"

namespace slamscope::apps {
namespace {

constexpr int kReachPx = 4;  // a click can't be asked to hit what is thinner

std::string sigmas(const Eigen::Matrix2d& P) {
  const Eigen::Vector2d sigma =
      slam::principalAxes(P).eigenvalues.cwiseMax(0.0).cwiseSqrt() * 100.0;  // cm
  char text[64];
  std::snprintf(text, sizeof text, "%.3g cm × %.3g cm (1σ)", sigma.x(), sigma.y());
  return text;
}

std::string featureText(int k, const DrawnMoment& drawn) {
  const slam::Snapshot& snapshot = drawn.snapshot;
  const slam::FeatureId id = snapshot.ids.at(static_cast<std::size_t>(k));
  const int row = slam::Snapshot::row(k);
  return "feature " + std::to_string(id) + (snapshot.isTentative(id) ? " (tentative)" : "") + ": " +
         sigmas(snapshot.covariance.block2(row, row)) +
         (drawn.alarms.feature(id) != nullptr ? ", flagged" : "");
}

std::string pairText(int i, int j, const DrawnMoment& drawn) {
  const slam::Snapshot& snapshot = drawn.snapshot;
  const slam::FeatureId a = snapshot.ids.at(static_cast<std::size_t>(i));
  const slam::FeatureId b = snapshot.ids.at(static_cast<std::size_t>(j));
  return "features " + std::to_string(a) + " and " + std::to_string(b) + ": relative " +
         sigmas(slam::relativeCovariance(snapshot, i, j)) +
         (drawn.alarms.pair(a, b) != nullptr ? ", flagged" : "");
}

GlyphMeaning meaningOf(const engine::Picked& picked) {
  if (picked.kind != engine::Picked::Kind::pair) return GlyphMeaning::ofTag(picked.tag);
  return {.what = GlyphMeaning::What::pair, .i = picked.i, .j = picked.j};
}

bool underPanel(const Eigen::Vector2d& pixel, const engine::Scene& scene) {
  const Eigen::Array2d corner = pixel.array() + 0.5;
  return std::ranges::any_of(scene.rects, [&corner](const engine::ScreenRect& rect) {
    return (corner >= rect.min_px.array()).all() && (corner < rect.max_px.array()).all();
  });
}

}  // namespace

std::string whatIsAt(const Eigen::Vector2d& pixel, std::uint32_t view, const DrawnMoment& drawn) {
  using What = GlyphMeaning::What;
  if (underPanel(pixel, drawn.scene)) return "words lie over the map there";
  const auto picked = drawn.offscreen.pick(
      {.view = view, .pixel = pixel.array().round().cast<int>(), .reach_px = kReachPx});
  const GlyphMeaning meaning = picked ? meaningOf(*picked) : GlyphMeaning{};
  const int i = static_cast<int>(meaning.i);
  const int j = static_cast<int>(meaning.j);
  switch (meaning.what) {
    case What::robot:
      return "the robot: " + sigmas(drawn.snapshot.covariance.block2(0, 0));
    case What::path:
      return "the robot's path";
    case What::feature:
      return featureText(i, drawn);
    case What::pair:
    case What::halo:
      return pairText(i, j, drawn);
    case What::mean:
      return "clusters " + std::to_string(i + 1) + " and " + std::to_string(j + 1) +
             ": the mean of the relative covariances between them";
    case What::unsaid:
      break;
  }
  return "nothing of the filter's there";
}

}  // namespace slamscope::apps
