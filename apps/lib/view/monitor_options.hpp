// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/lib/view/scene_builder.hpp"
#include "slam/audit/audit.hpp"
#include "slam/simulation.hpp"
#include "tracking/v4l2_source.hpp"

namespace slamscope::apps {

/// A request for the overhead view, as the command line states it.
struct MonitorOptions {
  std::string camera = "lab";  ///< `lab`, a device, a video, a directory or a pattern
  std::filesystem::path camera_info;
  std::filesystem::path tags;
  std::filesystem::path camera_pose;
  std::string robot;  ///< robot.yaml; `none`: the map starts at the origin of the tags' world
  bool continuous = false;
  tracking::V4l2Options v4l2;

  std::string slam = "simulate";  ///< run, `simulate`, `-`, `tcp://HOST:PORT`
  slam::SimulationOptions simulation;

  double fps = 0.0;                 ///< 0: the source's own, or 30
  double slam_rate = 1.0;           ///< seconds of the run per second of the camera
  double time_offset = 0.0;         ///< s, added to a frame's time before the run is asked
  std::optional<double> map_scale;  ///< absent: 1, or what fits a lab

  bool audit = true;  ///< flag what breaks the laws
  slam::AuditOptions audit_options;

  slam::PairMode mode = slam::PairMode::all;
  slam::AxisScale axis;
  std::vector<slam::FeatureId> selected;
  PairThinning thinning;
  std::optional<double> cluster_cut;  ///< m
  PaletteName palette = PaletteName::paper;
  double opacity = 1.0;
  bool covariance_rings = false;
  bool own_error = false;
  bool labels = true;
  bool legend = true;

  int width = 0, height = 0;      ///< of the drawn picture; 0: the camera's
  std::uint64_t frames = 0;       ///< to draw; 0: to the end
  std::optional<double> until;    ///< s, time of the run at which to stop; absent: to the end
  std::filesystem::path output;   ///< NAME.mp4, NAME-%05d.png
  std::filesystem::path picture;  ///< PNG or JPEG: the last frame
  std::filesystem::path compare;  ///< PNG or JPEG: the run's start and end beside each other
  std::filesystem::path report;
  std::filesystem::path lab_truth;
  std::uint64_t lab_seed = 1;
  std::string device;  ///< Vulkan device by index or name
  bool validation = false;
  bool window = false;
};

}  // namespace slamscope::apps
