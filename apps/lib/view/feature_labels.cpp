// SPDX-License-Identifier: MIT
#include "apps/lib/view/feature_labels.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "apps/lib/view/panel_layout.hpp"
#include "engine/scene/clip.hpp"
#include "engine/scene/label_placement.hpp"
#include "engine/scene/text_layout.hpp"

namespace slamscope::apps {
namespace {

/// Nearest first, no more than kMostLabels; whole up to twice the distance of the nearest, gone at
/// five times.
void fadeWithDistance(std::vector<engine::Label>& labels, const engine::View& view) {
  constexpr std::size_t kMostLabels = 150;
  const auto depth = [&view](const engine::Label& label) {
    return (view.T_eye_scene * label.anchor).z();
  };
  std::erase_if(labels, [&](const engine::Label& label) { return depth(label) <= 0.0; });
  if (labels.empty()) return;
  std::ranges::stable_sort(labels, {}, depth);
  const double nearest = depth(labels.front());
  if (labels.size() > kMostLabels) labels.resize(kMostLabels);
  for (engine::Label& label : labels) {
    const double share = (5.0 - depth(label) / nearest) / 3.0;
    label.colour.a *= static_cast<float>(std::clamp(share, 0.0, 1.0));
  }
  std::erase_if(labels, [](const engine::Label& label) { return label.colour.a <= 0.0F; });
}

}  // namespace

void spreadLabels(engine::Scene& scene, const engine::View& view, engine::FontAtlas& fonts) {
  std::vector<engine::PixelBox> obstacles;
  const auto pixel = [&view](const Eigen::Vector3d& p_scene) -> std::optional<Eigen::Vector2d> {
    const Eigen::Vector3d p_eye = view.T_eye_scene * p_scene;
    if (p_eye.z() < 0.05) return std::nullopt;
    return engine::project(view.camera, p_eye);
  };
  for (const engine::Cone& cone : scene.cones) {
    const auto tip = pixel(cone.tip);
    const auto rim = pixel(cone.tip + cone.height * Eigen::Vector3d::UnitZ());
    const auto side = pixel(cone.tip + Eigen::Vector3d(cone.radius, 0.0, cone.height));
    if (!tip || !rim || !side) continue;
    const Eigen::Vector2d radius = Eigen::Vector2d::Constant((*side - *rim).norm());
    obstacles.push_back(
        {.min_px = tip->cwiseMin(*rim - radius), .max_px = tip->cwiseMax(*rim + radius)});
  }
  for (const engine::ScreenRect& rect : scene.rects)
    obstacles.push_back({rect.min_px, rect.max_px});

  std::vector<engine::LabelRequest> requests;
  std::vector<engine::Label> in_view;
  const double text_px = PanelLayout(view.camera).text;
  fadeWithDistance(scene.labels, view);
  for (engine::Label& label : scene.labels) {
    label.height_px = text_px;
    const auto anchor = pixel(label.anchor);
    if (!anchor) continue;
    const engine::TextExtent extent = engine::measureText(fonts, label.text, label.height_px);
    requests.push_back({.anchor_px = *anchor,
                        .size_px = {extent.width_px, extent.height_px},
                        .last_offset_px = {}});
    in_view.push_back(std::move(label));
  }
  const engine::PixelBox picture{.min_px = Eigen::Vector2d::Zero(),
                                 .max_px = Eigen::Vector2d(view.camera.width, view.camera.height)};
  const auto offsets = engine::placeLabels(requests, obstacles, {.picture = picture});
  scene.labels.clear();
  for (std::size_t k = 0; k < in_view.size(); ++k) {
    if (!offsets[k]) continue;
    in_view[k].offset_px = *offsets[k];
    scene.labels.push_back(std::move(in_view[k]));
  }
}

}  // namespace slamscope::apps
