// SPDX-License-Identifier: MIT
// What the monitor composes: glyphs, status, legend.
#include <algorithm>
#include <cstdio>

#include "apps/lib/view/alarm_lines.hpp"
#include "apps/lib/view/monitor_state.hpp"

namespace slamscope::apps {

SceneStyle Monitor::State::style() const {
  // Cones and arrow have one size on the floor, so chosen that they suit the picture.
  constexpr double kConeShare = 0.09;  // of the picture's height, seen from the side
  const double cone = kConeShare * camera.pinhole.height * metres_per_px;
  return {.mode = choices.mode,
          .axis = choices.axis,
          .selected = options.selected,
          .map_scale = setup.map_scale,
          .covariance_rings = choices.covariance_rings,
          .labels = choices.labels,
          .cone_height = cone,
          .cone_radius = 0.15 * cone,
          .arrow_length = 1.1 * cone,
          .viewer_up = registered()->T_camera_map.linear().transpose() * -Eigen::Vector3d::UnitY()};
}

std::string Monitor::State::runLine() const {
  char text[200];
  const slam::Snapshot& snapshot = *slam.newest();
  const double age =
      feed->live() ? seconds(slam.sinceArrival()) : seconds(run_time - snapshot.time);
  std::snprintf(text, sizeof text,
                "t %.2f s · record %llu, %.2f s old · %d features · %zu ellipsoids · mode %s",
                seconds(snapshot.time), static_cast<unsigned long long>(snapshot.sequence),
                std::max(age, 0.0), snapshot.featureCount(), ellipsoidCount(picture.scene),
                std::string(slam::pairModeName(choices.mode)).c_str());
  return text;
}

std::vector<std::string> Monitor::State::statusLines() const {
  std::vector<std::string> lines;
  if (slam.newest()) {
    lines.emplace_back(runLine());
    if (slam.newest()->diagonal_only) {
      lines.emplace_back("only the diagonal of P was logged: relative covariances are unknown");
    }
  } else {
    lines.emplace_back("no record of the filter yet");
  }
  lines.emplace_back((setup.calibrated ? "" : "uncalibrated · ") + registration.status());
  for (const std::string& problem : registration.problems()) lines.emplace_back(problem);
  if (const std::string link = feed->status(); !link.empty()) lines.emplace_back(link);
  if (clustered() && slam.framesSinceRepartition() < 45)
    lines.emplace_back("the clusters have changed");
  if (slam.stopped()) lines.emplace_back("the picture stops at " + *slam.stopped());
  if (!choices.message.empty()) lines.emplace_back(choices.message);
  return lines;
}

Legend Monitor::State::legend() const {
  const slam::Clustering& clusters = slam.clusters();
  return {.mode = choices.mode,
          .axis = choices.axis,
          .map_scale = setup.map_scale,
          .covariance_rings = choices.covariance_rings,
          .clusters = clustered() ? clusters.count() : 0,
          .cluster_cut = clusters.cut,
          .automatic_cut = clusters.automatic,
          .flagged = choices.mode == slam::PairMode::alarms || !alarms.empty(),
          .px_per_m = 1.0 / metres_per_px};
}

void Monitor::State::compose() {
  picture.scene = {};
  picture.render.opacity = static_cast<float>(choices.opacity);
  if (shown()) {
    picture.view.T_eye_scene = registered()->T_camera_map;
    picture.scene = buildScene({.snapshot = *slam.newest(),
                                .path = slam.path(),
                                .clusters = slam.clusters(),
                                .alarms = alarms},
                               style());
  }
  addStatus(picture.scene, statusLines(), camera.pinhole, fonts);
  if (!shown()) return;
  if (choices.legend) addLegend(picture.scene, legend(), camera.pinhole, fonts);
  if (audit) {
    const bool asked = choices.mode == slam::PairMode::alarms;
    addAlarms(picture.scene, alarmLines(audit->newest(), slam.newest()->time, asked),
              camera.pinhole, fonts);
  }
  spreadLabels(picture.scene, picture.view, fonts);
}

}  // namespace slamscope::apps
