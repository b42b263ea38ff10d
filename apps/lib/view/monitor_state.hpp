// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/lib/audit_watch.hpp"
#include "apps/lib/run_truth.hpp"
#include "apps/lib/slam_feed.hpp"
#include "apps/lib/view/alarm_marks.hpp"
#include "apps/lib/view/camera_setup.hpp"
#include "apps/lib/view/frame_prefetch.hpp"
#include "apps/lib/view/legend.hpp"
#include "apps/lib/view/monitor.hpp"
#include "apps/lib/view/monitor_report.hpp"
#include "apps/lib/view/output_camera.hpp"
#include "apps/lib/view/picture_output.hpp"
#include "apps/lib/view/run_clock.hpp"
#include "apps/lib/view/slam_view.hpp"
#include "engine/render/offscreen.hpp"
#include "tracking/tag_detector.hpp"

namespace slamscope::apps {

/// All that a Monitor holds. What it takes in: monitor_input.cpp; what it composes of it:
/// monitor_picture.cpp; what it hands on: monitor_output.cpp.
struct Monitor::State {
  explicit State(const MonitorOptions& request);

  bool next();
  void detect(const tracking::Frame& frame);
  void judge();
  [[nodiscard]] bool runIsOver() const;

  void compose();
  [[nodiscard]] SceneStyle style() const;
  [[nodiscard]] std::vector<std::string> statusLines() const;
  [[nodiscard]] std::string runLine() const;
  [[nodiscard]] Legend legend() const;
  [[nodiscard]] bool clustered() const {
    return choices.mode == slam::PairMode::between_clusters ||
           choices.mode == slam::PairMode::min_mean_max;
  }

  void draw();
  void hand();
  void compare();
  [[nodiscard]] FrameReport frameReport() const;
  void finish();

  [[nodiscard]] const std::optional<tracking::RegistrationResult>& registered() const {
    return registration.result();
  }
  [[nodiscard]] bool shown() const { return registered().has_value() && slam.newest() != nullptr; }

  MonitorOptions options;
  std::optional<RunTruth> truth;
  CameraSetup setup;
  std::unique_ptr<SlamFeed> feed;
  SlamView slam;
  std::optional<AuditWatch> audit;
  OutputCamera camera;
  tracking::TagDetector detector;
  tracking::Registration registration;
  FramePrefetch frames;
  std::shared_ptr<engine::Gpu> gpu;
  engine::Offscreen offscreen;
  engine::FontAtlas fonts;
  std::unique_ptr<PictureOutput> output;
  MonitorReport report;

  Choices choices;
  RunClock clock;
  std::optional<std::chrono::nanoseconds> first_time;
  std::chrono::nanoseconds frame_time{};
  std::chrono::nanoseconds frame_step{};
  std::chrono::nanoseconds run_time{};
  std::uint64_t frame_count = 0;
  std::uint64_t drawn_frame = 0;
  bool ever_registered = false;
  AlarmMarks alarms;           ///< of the newest judgement
  double metres_per_px = 0.0;  ///< at the map's origin, when it was first registered
  Picture picture;
  std::vector<engine::Image> pixels;
  std::optional<engine::Image> start_picture;
};

using slam::seconds;

/// Milliseconds since it was made or last asked.
class StopWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double passed = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return passed;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace slamscope::apps
