// SPDX-License-Identifier: MIT
// What the monitor hands on: drawn pictures and the report.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "apps/lib/view/monitor_state.hpp"
#include "apps/lib/view/overlay.hpp"

namespace slamscope::apps {

void Monitor::State::draw() {
  StopWatch watch;
  compose();
  report.addStage("scene", watch.lap());
  offscreen.draw({&picture.view, 1}, picture.scene, picture.render, pixels);
  layer.drawn(offscreen.lastStats().pairs);
  report.addDeviceMemory(offscreen.lastStats().device_bytes);
  report.addStage("draw", watch.lap());
  if (drawn_frame == frame_count) return;
  drawn_frame = frame_count;
  hand();
  report.addStage("write", watch.lap());
}

void Monitor::State::hand() {
  if (output) output->write(pixels.front());
  if (!options.report.empty()) report.add(frameReport());
  const bool something = ellipsoidCount(picture.scene, offscreen.lastStats().pairs) > 0 ||
                         (choices.mode == slam::PairMode::alarms && shown());
  if (!options.compare.empty() && !start_picture && something) {
    compose();  // once more, now that it is known how many pairs were drawn
    offscreen.draw({&picture.view, 1}, picture.scene, picture.render, pixels);
    start_picture = pixels.front();
  }
  if (shown() && (options.compare.empty() || start_picture)) skipToTheEnd();
}

/// Where only pictures of the end are wanted, the lab can go straight there.
void Monitor::State::skipToTheEnd() {
  const bool looked_at = output || !options.report.empty() || options.window || options.frames > 0;
  const bool remembers = options.thinning.by == engine::MostBy::growth;
  if (looked_at || remembers || skipped || !setup.lab || !truth) return;
  skipped = true;
  const double end = std::min(seconds(truth->end), options.until.value_or(seconds(truth->end)));
  const double left = (end - seconds(layer.runTime())) / options.slam_rate;
  const double count = std::floor(left * setup.lab->fps) - 1.0;
  if (count >= 1.0) frames.skip(static_cast<std::uint64_t>(count));
}

FrameReport Monitor::State::frameReport() const {
  FrameReport frame{.time_s = seconds(frame_time),
                    .snapshot_time_s = {},
                    .state = registration.state(),
                    .registration = registered(),
                    .overlay_errors_px = {},
                    .slam_error_m = {},
                    .tips = {},
                    .judgement = {}};
  if (layer.audit()) frame.judgement = layer.audit()->newest();
  if (layer.newest()) frame.snapshot_time_s = seconds(layer.newest()->time);
  if (!shown()) return frame;
  const slam::Snapshot& snapshot = *layer.newest();
  frame.ellipsoids = ellipsoidCount(picture.scene, offscreen.lastStats().pairs);
  frame.features = picture.scene.cones.size() - 1;  // one is the robot's

  Overlay overlay{.camera = camera.pinhole,
                  .T_camera_map = picture.view.T_eye_scene,
                  .true_T_camera_map = {},
                  .map_scale = setup.map_scale};
  if (setup.lab) {
    overlay.true_T_camera_map = setup.lab->T_world_camera.inverse() * setup.lab->T_world_map;
  }
  measureOverlay(overlay, snapshot, frame);
  return frame;
}

void Monitor::State::finish(Viewer::Ending ending) {
  if (!options.report.empty()) report.write(options.report);
  const bool in_vain = ending == Viewer::Ending::input_ended && !setup.source->live();
  if (in_vain && !ever_registered && (!setup.lab || frame_count > 0)) {
    throw std::runtime_error(options.camera + ": never registered in " +
                             std::to_string(frame_count) + " frames (" + registration.status() +
                             ")");
  }
  if (output) output->finish();
  if (!options.picture.empty()) writePicture(options.picture, pixels.front());
  if (!options.compare.empty()) {
    if (!start_picture) throw std::runtime_error("--compare: no ellipsoid was ever drawn");
    writePicture(options.compare, sideBySide(*start_picture, pixels.front()));
  }
}

}  // namespace slamscope::apps
