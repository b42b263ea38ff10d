// SPDX-License-Identifier: MIT
// What the monitor takes in: frames, the pose of the camera, the filter's records.
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "apps/lib/view/monitor_state.hpp"
#include "engine/window/window.hpp"

namespace slamscope::apps {
namespace {

std::optional<RunTruth> truthFor(const MonitorOptions& options) {
  if (options.camera != "lab" || options.slam == "-" || options.slam.starts_with("tcp://")) {
    return std::nullopt;
  }
  if (options.slam == "simulate") return truthOfSimulation(options.simulation);
  return truthOfRun(options.slam);
}

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
    : options(request),
      truth(truthFor(request)),
      setup(openCamera(request, truth)),
      feed(openSlamFeed(request.slam, request.simulation)),
      slam(*feed, request.cluster_cut),
      camera(makeOutputCamera(setup.info, request.width, request.height)),
      detector(detectorOptions(setup)),
      registration(setup.registration, tracking::CameraModel(setup.info)),
      frames(*setup.source),
      gpu(std::make_shared<engine::Gpu>(engine::GpuOptions{
          .device = request.device,
          .validation = request.validation,
          .instance_extensions =
              request.window ? engine::windowInstanceExtensions() : std::vector<std::string>{}})),
      offscreen(gpu, camera.pinhole.width, camera.pinhole.height) {
  choices = {.mode = request.mode,
             .axis = request.axis,
             .covariance_rings = request.covariance_rings,
             .labels = request.labels,
             .legend = request.legend,
             .opacity = request.opacity,
             .message = {}};
  if (request.audit) audit.emplace(*feed, request.audit_options);
  if (!request.output.empty()) output = openPictureOutput(request.output, setup.fps);
  if (!request.lab_truth.empty()) {
    if (!setup.lab) throw std::runtime_error("--lab-truth: only the lab knows its truth");
    tracking::writeLabTruth(*setup.lab, request.lab_truth);
  }
  picture.view.camera = camera.pinhole;
  picture.view.background.map = camera.map;
}

bool Monitor::State::runIsOver() const {
  // A lab has no end of its own; a camera or a film is shown to its end.
  return setup.lab && feed->ended() && (registered() || slam.newest() == nullptr);
}

bool Monitor::State::next() {
  if (options.frames > 0 && frame_count >= options.frames) return false;
  if (frame_count > 0 && runIsOver()) return false;
  StopWatch watch;
  const std::optional<tracking::Frame> frame = frames.next();
  if (!frame) return false;
  report.addStage("frame", watch.lap());
  if (!first_time) {
    first_time = frame->time;
    if (const auto start = feed->start()) {
      clock =
          RunClock({.run_start = *start,
                    .first_frame = frame->time,
                    .frames_stamped = setup.source->stamped(),
                    .rate = options.slam_rate,
                    .offset = std::chrono::nanoseconds(std::llround(1e9 * options.time_offset))});
      if (!clock.sameClock()) {
        char note[96];
        std::snprintf(note, sizeof note, "the first frame is laid on the run's start, t = %.3f s",
                      seconds(*start));
        setup.notes.emplace_back(note);
      }
    }
  }
  if (frame_count > 0) frame_step = frame->time - frame_time;
  frame_time = frame->time;
  run_time = clock.runTime(frame_time);
  ++frame_count;
  detect(*frame);
  report.addStage("detect", watch.lap());
  if (!audit || !feed->live() || !audit->full()) slam.advanceTo(run_time);
  report.addStage("slam", watch.lap());
  judge();
  report.addStage("audit", watch.lap());
  picture.view.background.image = toImage(*frame);
  return true;
}

void Monitor::State::judge() {
  if (!audit) return;
  // A film shows each alarm at its record, however long that takes; before somebody's eyes the
  // picture goes on.
  const bool nobody_waits = !options.window && !feed->live();
  if (nobody_waits) {
    audit->settle();
  } else {
    audit->advance();
  }
  alarms = AlarmMarks(audit->newest());
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
