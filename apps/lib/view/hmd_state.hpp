// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/lib/view/head_view.hpp"
#include "apps/lib/view/hmd.hpp"
#include "apps/lib/view/hmd_report.hpp"
#include "apps/lib/view/latency_log.hpp"
#include "apps/lib/view/picture_output.hpp"
#include "apps/lib/view/stereo_picture.hpp"
#include "apps/lib/view/stop_watch.hpp"
#include "apps/lib/view/viewed_run.hpp"

namespace slamscope::apps {

/// All that a Hmd holds. What it takes in and composes: hmd.cpp; what it hands on: hmd_output.cpp.
struct Hmd::State : ViewedRun {
  explicit State(const HmdOptions& asked);

  bool next();
  [[nodiscard]] bool runIsOver() const;
  [[nodiscard]] int registrationPairs() const;

  void compose();
  [[nodiscard]] std::vector<std::string> lines() const;
  void draw();
  void hand();
  [[nodiscard]] HmdFrame frameReport() const;
  void explain(const Eigen::Vector2d& pixel);
  void finish(Viewer::Ending ending);

  HmdOptions request;  ///< `options` is its part `view`
  StereoSetup setup;
  HeadView head;
  PairPrefetch pairs;
  StereoPicture picture;
  std::unique_ptr<PictureOutput> output;
  std::optional<LatencyLog> latency;
  MonitorReport report;

  engine::Scene scene;
  engine::RenderOptions render;
  std::vector<std::string> problems;
  FrameStations stations;
  std::optional<double> latency_ms;  ///< of the frame before: what the status line says
  std::uint64_t drawn_frame = 0, presented_frame = 0;
  double metres_per_px = 0.0;  ///< at the map's origin, when it was first seen in its place
  bool ever_shown = false;
};

}  // namespace slamscope::apps
