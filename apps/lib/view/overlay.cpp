// SPDX-License-Identifier: MIT
#include "apps/lib/view/overlay.hpp"

#include <cmath>

#include "engine/scene/clip.hpp"

namespace slamscope::apps {
namespace {

bool inside(const engine::Pinhole& camera, const Eigen::Vector2d& px) {
  return px.x() >= 0.0 && px.y() >= 0.0 && px.x() <= camera.width - 1.0 &&
         px.y() <= camera.height - 1.0;
}

std::optional<double> slamError(const slam::Snapshot& snapshot) {
  if (!snapshot.truth) return std::nullopt;
  const slam::Truth& truth = *snapshot.truth;
  double squares = 0.0;
  int known = 0;
  for (std::size_t k = 0; k < truth.ids.size(); ++k) {
    const auto index = snapshot.indexOf(truth.ids[k]);
    if (!index) continue;
    const Eigen::Vector2d& estimate = snapshot.features[static_cast<std::size_t>(*index)];
    squares += (estimate - truth.features[k]).squaredNorm();
    ++known;
  }
  if (known == 0) return std::nullopt;
  return std::sqrt(squares / known);
}

}  // namespace

void measureOverlay(const Overlay& overlay, const slam::Snapshot& snapshot, FrameReport& frame) {
  for (std::size_t k = 0; k < snapshot.ids.size(); ++k) {
    const Eigen::Vector2d p_floor = overlay.map_scale * snapshot.features[k];
    const Eigen::Vector3d p_map(p_floor.x(), p_floor.y(), 0.0);
    const Eigen::Vector3d p_camera = overlay.T_camera_map * p_map;
    if (p_camera.z() <= 0.0) continue;
    const Eigen::Vector2d px = engine::project(overlay.camera, p_camera);
    if (!inside(overlay.camera, px)) continue;
    frame.tips.push_back({snapshot.ids[k], px});
    if (!overlay.true_T_camera_map) continue;
    const Eigen::Vector2d true_px =
        engine::project(overlay.camera, *overlay.true_T_camera_map * p_map);
    frame.overlay_errors_px.push_back((px - true_px).norm());
  }
  frame.slam_error_m = slamError(snapshot);
}

}  // namespace slamscope::apps
