// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <deque>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/lib/run_truth.hpp"
#include "apps/lib/view/hmd_options.hpp"
#include "tracking/robot_tag.hpp"
#include "tracking/stereo_lab.hpp"
#include "tracking/stereo_source.hpp"

namespace slamscope::apps {

/// The cameras on a head and what is needed to find it in the room.
struct StereoSetup {
  std::unique_ptr<tracking::StereoSource> source;
  std::deque<tracking::StereoFrame> ahead;  ///< taken already: to be shown first
  tracking::Rig rig;                        ///< as many cameras as the source has
  tracking::TagLayout tags;
  bool tags_known = true;  ///< false: one tag stands for the room
  /// The robot's tag; absent: the map starts at the origin of the tags' world.
  std::optional<tracking::RobotTag> robot;
  double fps = 30.0;  ///< what a film is played at
  double map_scale = 1.0;
  /// Of a lab: where its true poses come from (the source paints on a thread of its own), and
  /// where the map truly lies.
  tracking::StereoLab* lab = nullptr;
  std::vector<std::string> notes;

  [[nodiscard]] bool calibrated() const { return rig.calibrated && tags_known; }
};

/// Opens what the options name; see CameraSetup. Throws std::runtime_error, one line.
[[nodiscard]] StereoSetup openStereo(const HmdOptions& options,
                                     const std::optional<RunTruth>& truth);

/// The rig that is drawn for: two eyes. Where there is one camera the other eye is put beside it,
/// 64 mm to the right unless T_right_left says otherwise.
[[nodiscard]] tracking::Rig drawnRig(const tracking::Rig& rig);

/// A pair of frames, when it was there, and what was wrong with it.
struct TakenPair {
  tracking::StereoFrame frame;
  std::chrono::steady_clock::time_point dequeued;
  std::vector<std::string> problems;
};

/// Gets the next pair on a thread of its own while this one is worked on.
class PairPrefetch {
 public:
  explicit PairPrefetch(StereoSetup& setup) : setup_(setup) {}
  [[nodiscard]] std::optional<TakenPair> next();

 private:
  [[nodiscard]] std::optional<TakenPair> take();

  StereoSetup& setup_;
  std::future<std::optional<TakenPair>> ahead_;  // last member: its destructor waits
};

}  // namespace slamscope::apps
