// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "slam/laser_lab.hpp"
#include "slam/run_recording.hpp"

namespace slamscope::apps {

/// What `slamscope slam` reads and how, as the command line states it. Lists that were not given
/// are empty: the recording's own numbers, or the defaults of its kind, hold then.
struct SlamFlags {
  std::string mrclam;
  int robot = 0;
  std::string csv;
  std::string victoria_park;
  std::string isam;
  std::string mrpt;
  slam::LaserLabOptions laser_lab{.loops = 0};  ///< no loops: none

  std::string vehicle;  ///< "ackermann"; empty: what the odometry says
  double wheelbase = 0.0;
  double encoder_left = 0.0;
  std::vector<double> laser_pose;  ///< x, y (m), degrees
  std::optional<double> sweep;     ///< s
  std::vector<double> view;        ///< m, degrees to each side
  std::vector<double> diameters;   ///< m, least and greatest

  std::string association;
  std::string update = "batch";
  std::string linearisation = "newest";
  std::vector<double> sensor_sigma;
  std::vector<double> odometry_sigma;
  std::vector<double> initial_sigma;
  std::optional<double> gate;  ///< 0: none
  std::optional<double> fresh_gate;
  std::optional<double> fresh_density;  ///< 1/m²
  std::optional<double> odds;
  std::optional<int> confirm;
  std::optional<int> drop;
  std::optional<int> drop_confirmed;
  std::optional<double> longest_doubt;  ///< s
  int hypotheses = 0;
  std::optional<double> error_memory;  ///< s
  std::optional<double> separation;    ///< m
  std::optional<double> laser_range;   ///< m
  std::optional<double> reflector;

  std::string record = "steps";
  std::string output;
  bool score = false;
  std::string score_json;
};

void addSlamFlags(CLI::App& verb, SlamFlags& flags);

/// Reads the recording, with what the flags say of vehicle and laser. Throws std::runtime_error.
[[nodiscard]] slam::Recording readRecording(const SlamFlags& flags);

/// Options of a run over that recording.
[[nodiscard]] slam::RecordingRunOptions runOptions(const SlamFlags& flags,
                                                   const slam::Recording& recording);

}  // namespace slamscope::apps
