// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/lib/run_truth.hpp"
#include "apps/lib/view/monitor_options.hpp"
#include "apps/lib/view/slam_layer.hpp"
#include "apps/lib/view/viewer.hpp"

namespace slamscope::apps {

/// What every viewer keeps of a run, whichever cameras it is seen by: what was asked for and chosen
/// since, what is laid over the pictures, and how far the frames have come.
struct ViewedRun {
  explicit ViewedRun(const MonitorOptions& request);

  /// The next frame was taken at `time`. `stamped`: by a clock that the run may share.
  void arrive(std::chrono::nanoseconds time, bool stamped);

  MonitorOptions options;
  std::optional<RunTruth> truth;
  Viewer::Choices choices;
  std::shared_ptr<engine::Gpu> gpu;
  SlamLayer layer;

  bool live_frames = false;                    ///< the source gives them when they are taken
  std::optional<std::uint64_t> source_frames;  ///< how many it has, where that is known
  std::vector<std::string> notes;              ///< on how the inputs were taken
  std::optional<std::chrono::nanoseconds> first_time;
  std::chrono::nanoseconds frame_time{}, frame_step{};
  std::uint64_t frame_count = 0;
};

}  // namespace slamscope::apps
