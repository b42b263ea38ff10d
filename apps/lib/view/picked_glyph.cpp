// SPDX-License-Identifier: MIT
#include "apps/lib/view/picked_glyph.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/scene/clip.hpp"
#include "engine/scene/pair_pick.hpp"
#include "slam/correlation.hpp"

namespace slamscope::apps {
namespace {

constexpr double kReachPx = 12.0;  // of a click, to the tip of a cone

std::string sigmas(const Eigen::Matrix2d& P) {
  const Eigen::Vector2d sigma =
      slam::principalAxes(P).eigenvalues.cwiseMax(0.0).cwiseSqrt() * 100.0;  // cm
  char text[64];
  std::snprintf(text, sizeof text, "%.3g cm × %.3g cm (1σ)", sigma.x(), sigma.y());
  return text;
}

std::optional<int> featureAt(const Eigen::Vector2d& pixel, const slam::Snapshot& snapshot,
                             const engine::View& view, double map_scale) {
  std::optional<int> nearest;
  double least = kReachPx;
  for (int k = 0; k < snapshot.featureCount(); ++k) {
    const Eigen::Vector2d p = map_scale * snapshot.features[static_cast<std::size_t>(k)];
    const Eigen::Vector3d p_eye = view.T_eye_scene * Eigen::Vector3d(p.x(), p.y(), 0.0);
    if (!(p_eye.z() > 0.0)) continue;
    const double distance = (engine::project(view.camera, p_eye) - pixel).norm();
    if (distance > least) continue;
    least = distance;
    nearest = k;
  }
  return nearest;
}

}  // namespace

std::string whatIsAt(const Eigen::Vector2d& pixel, const engine::Scene& scene,
                     const slam::Snapshot& snapshot, const engine::View& view, double map_scale) {
  const auto id = [&snapshot](std::size_t index) { return std::to_string(snapshot.ids[index]); };
  if (const auto k = featureAt(pixel, snapshot, view, map_scale)) {
    const int row = slam::Snapshot::row(*k);
    return "feature " + id(static_cast<std::size_t>(*k)) + ": " +
           sigmas(snapshot.covariance.block2(row, row));
  }
  if (scene.pairs) {
    if (const auto pair = engine::pickPair(*scene.pairs, view, pixel)) {
      return "features " + id(pair->i) + " and " + id(pair->j) + ": relative " +
             sigmas(slam::relativeCovariance(snapshot, static_cast<int>(pair->i),
                                             static_cast<int>(pair->j)));
    }
  }
  return "nothing of the filter's there";
}

}  // namespace slamscope::apps
