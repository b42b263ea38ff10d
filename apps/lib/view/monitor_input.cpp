// SPDX-License-Identifier: MIT
// What the monitor takes in: frames, the pose of the camera, the filter's records.
#include <stdexcept>
#include <utility>

#include "apps/lib/view/monitor_state.hpp"

namespace slamscope::apps {
namespace {

tracking::TagDetectorOptions detectorOptions(const CameraSetup& setup) {
  const auto& registration = setup.registration;
  return {.family = registration.layout.tags.empty() && registration.robot
                        ? registration.robot->family
                        : registration.layout.family,
          .threads = 2,
          .quad_decimate = {},
          .camera = tracking::CameraModel(setup.info)};
}

}  // namespace

Monitor::State::State(const MonitorOptions& request)
    : ViewedRun(request),
      setup(openCamera(request, truth)),
      camera(makeOutputCamera(setup.info, request.width, request.height)),
      source_camera(setup.info),
      detector(detectorOptions(setup)),
      registration(setup.registration, source_camera),
      frames(*setup.source),
      offscreen(gpu, camera.pinhole.width, camera.pinhole.height) {
  live_frames = setup.source->live();
  source_frames = setup.source->count();
  notes = setup.notes;
  if (!request.output.empty()) output = openPictureOutput(request.output, setup.fps);
  if (!request.lab_truth.empty()) {
    if (!setup.lab) throw std::runtime_error("--lab-truth: only the lab knows its truth");
    tracking::writeLabTruth(*setup.lab, request.lab_truth);
  }
  picture.view.camera = camera.pinhole;
}

bool Monitor::State::runIsOver() const {
  if (options.until && shown() && seconds(layer.runTime()) >= *options.until) return true;
  // A lab has no end of its own; a camera or a film is shown to its end.
  return setup.lab && layer.feed().ended() && (registered() || layer.newest() == nullptr);
}

bool Monitor::State::next() {
  if (options.frames > 0 && frame_count >= options.frames) return false;
  if (frame_count > 0 && runIsOver()) return false;
  StopWatch watch;
  const std::optional<tracking::Frame> frame = frames.next();
  if (!frame) return false;
  report.addStage("frame", watch.lap());
  arrive(frame->time, setup.source->stamped());
  detect(*frame);
  report.addStage("detect", watch.lap());
  layer.advance(frame_time);
  report.addStage("slam", watch.lap());
  layer.judge();
  report.addStage("audit", watch.lap());
  picture.view.background = backgroundOf(*frame, camera, gpu->device());
  return true;
}

void Monitor::State::detect(const tracking::Frame& frame) {
  const bool stored = !options.continuous && registered().has_value();
  if (stored) return;
  registration.add(frame.time, detector.detect(frame));
  if (!registered() || ever_registered) return;
  ever_registered = true;
  const double depth = registered()->T_camera_map.translation().z();
  metres_per_px = depth / camera.pinhole.fx;
}

}  // namespace slamscope::apps
