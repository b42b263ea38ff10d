// SPDX-License-Identifier: MIT
// What the HMD's view hands on: drawn pictures, the report, the stamps.
#include <stdexcept>

#include "apps/lib/view/hmd_state.hpp"
#include "apps/lib/view/overlay.hpp"
#include "apps/lib/view/picked_glyph.hpp"
#include "engine/scene/lens.hpp"

namespace slamscope::apps {

using slam::seconds;

void Hmd::State::draw() {
  StopWatch watch;
  compose();
  report.addStage("scene", watch.lap());
  picture.draw(scene, render);
  layer.drawn(picture.lastStats().pairs);
  report.addDeviceMemory(picture.lastStats().device_bytes);
  report.addStage("draw", watch.lap());
  if (drawn_frame == frame_count) return;
  drawn_frame = frame_count;
  hand();
  report.addStage("write", watch.lap());
}

void Hmd::State::hand() {
  if (output) output->write(picture.drawn());
  if (options.report.empty()) return;
  const HmdFrame frame = frameReport();
  std::vector<double> errors = frame.eyes[0].overlay_errors_px;
  errors.insert(errors.end(), frame.eyes[1].overlay_errors_px.begin(),
                frame.eyes[1].overlay_errors_px.end());
  report.addFrame(hmdFrameJson(frame), errors);
}

HmdFrame Hmd::State::frameReport() const {
  HmdFrame frame{.head = head, .problems = problems, .true_T_world_map = {}, .eyes = {}};
  if (setup.lab != nullptr) frame.true_T_world_map = setup.lab->options().room.T_world_map;
  for (std::size_t eye = 0; eye < frame.eyes.size(); ++eye) {
    FrameReport& drawn = frame.eyes[eye];
    const EyeSight& sight = head.eyes()[eye];
    drawn.time_s = seconds(frame_time);
    if (layer.audit()) drawn.judgement = layer.audit()->newest();
    if (!layer.newest()) continue;
    drawn.snapshot_time_s = seconds(layer.newest()->time);
    if (!sight.T_eye_map || scene.cones.empty()) continue;
    drawn.ellipsoids = ellipsoidCount(scene, picture.lastStats().pairs);
    drawn.features = scene.cones.size() - 1;  // one is the robot's
    measureOverlay({.camera = picture.views()[eye].camera,
                    .T_camera_map = *sight.T_eye_map,
                    .true_T_camera_map = sight.true_T_eye_map,
                    .map_scale = setup.map_scale},
                   *layer.newest(), drawn);
  }
  return frame;
}

void Hmd::State::explain(const Eigen::Vector2d& pixel) {
  if (!layer.newest() || scene.cones.empty()) return;
  const EyePixel drawn = picture.underLens(pixel);
  choices.message = whatIsAt(drawn.pixel, static_cast<std::uint32_t>(drawn.eye),
                             {.offscreen = picture.offscreen(),
                              .scene = scene,
                              .snapshot = *layer.newest(),
                              .alarms = layer.alarms()});
}

void Hmd::State::finish(Viewer::Ending ending) {
  if (!options.report.empty()) report.write(options.report);
  const bool in_vain = ending == Viewer::Ending::input_ended && !setup.source->live();
  if (in_vain && !ever_shown && (setup.lab == nullptr || frame_count > 0)) {
    std::string why = head.statusLines().front();
    for (const std::string& problem : problems) why += "; " + problem;
    throw std::runtime_error(options.camera + ": the map was never found in " +
                             std::to_string(frame_count) + " frames (" + why + ")");
  }
  if (output) output->finish();
  if (!options.picture.empty()) writePicture(options.picture, picture.drawn());
}

void Hmd::presented() {
  State& state = *state_;
  if (state.presented_frame == state.frame_count) return;
  state.presented_frame = state.frame_count;
  state.stations.presented = std::chrono::steady_clock::now();
  const double software = softwareLatencyMs(state.stations);
  state.report.addStage("dequeue_to_present", software);
  state.latency_ms = wholeLatencyMs(state.stations);
  if (!state.latency_ms && state.options.window) state.latency_ms = software;
  if (state.latency) state.latency->add(state.stations);
}

}  // namespace slamscope::apps
