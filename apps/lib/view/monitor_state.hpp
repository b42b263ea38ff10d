// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/lib/view/camera_setup.hpp"
#include "apps/lib/view/frame_prefetch.hpp"
#include "apps/lib/view/monitor.hpp"
#include "apps/lib/view/monitor_report.hpp"
#include "apps/lib/view/output_camera.hpp"
#include "apps/lib/view/picture_output.hpp"
#include "apps/lib/view/stop_watch.hpp"
#include "apps/lib/view/viewed_run.hpp"
#include "engine/render/offscreen.hpp"
#include "tracking/tag_detector.hpp"

namespace slamscope::apps {

/// All that a Monitor holds. What it takes in: monitor_input.cpp; what it composes of it:
/// monitor_picture.cpp; what it hands on: monitor_output.cpp.
struct Monitor::State : ViewedRun {
  explicit State(const MonitorOptions& request);

  bool next();
  void detect(const tracking::Frame& frame);
  [[nodiscard]] bool runIsOver() const;

  void compose();

  void draw();
  void hand();
  void skipToTheEnd();
  [[nodiscard]] FrameReport frameReport() const;
  void finish(Viewer::Ending ending);

  [[nodiscard]] const std::optional<tracking::RegistrationResult>& registered() const {
    return registration.result();
  }
  [[nodiscard]] bool shown() const { return registered().has_value() && layer.newest() != nullptr; }

  CameraSetup setup;
  OutputCamera camera;
  tracking::CameraModel source_camera;
  tracking::TagDetector detector;
  tracking::Registration registration;
  FramePrefetch frames;
  engine::Offscreen offscreen;
  std::unique_ptr<PictureOutput> output;
  MonitorReport report;

  std::uint64_t drawn_frame = 0;
  bool ever_registered = false;
  bool skipped = false;        ///< to the end
  double metres_per_px = 0.0;  ///< at the map's origin, when it was first registered
  Picture picture;
  std::vector<engine::Image> pixels;
  std::optional<engine::Image> start_picture;
};

using slam::seconds;

}  // namespace slamscope::apps
