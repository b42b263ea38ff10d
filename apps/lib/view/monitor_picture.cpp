// SPDX-License-Identifier: MIT
// What the monitor composes: glyphs, status, legend.
#include "apps/lib/view/monitor_state.hpp"

namespace slamscope::apps {

void Monitor::State::compose() {
  std::vector<std::string> lines{(setup.calibrated ? "" : "uncalibrated · ") +
                                 registration.status()};
  lines.insert(lines.end(), registration.problems().begin(), registration.problems().end());
  picture.render.opacity = static_cast<float>(choices.opacity);
  std::optional<SlamLayer::Place> place;
  if (shown()) {
    const Eigen::Isometry3d& T_camera_map = picture.view.T_eye_scene = registered()->T_camera_map;
    place.emplace(SlamLayer::Place{
        .view = picture.view,
        .map_scale = setup.map_scale,
        .metres_per_px = metres_per_px,
        .viewer_up = T_camera_map.linear().transpose() * -Eigen::Vector3d::UnitY(),
        .own_error = [this](const Eigen::Vector3d& p_scene) {
          return tracking::overlayCovarianceOnFloor(source_camera, *registered(), p_scene);
        }});
  }
  picture.scene = layer.compose(place, camera.pinhole, lines);
}

}  // namespace slamscope::apps
