// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>

namespace slamscope::apps {

/// When a frame passed the four stations from camera to eye. All but the first are of the
/// computer's steady clock, as is the first where a camera stamps its frames with that clock.
struct FrameStations {
  std::chrono::nanoseconds mid_exposure{};  ///< the source's clock
  std::chrono::steady_clock::time_point dequeued, pose, presented;
};

/// Writes them as CSV, a line a frame: frame, mid_exposure_s, dequeue_s, pose_s, present_s.
class LatencyLog {
 public:
  /// Throws std::runtime_error where the file can't be written.
  explicit LatencyLog(const std::filesystem::path& file);
  void add(const FrameStations& stations);

 private:
  std::ofstream out_;
  std::uint64_t frames_ = 0;
};

/// ms from the hand-over of the frame (all that software is answerable for) to the picture.
[[nodiscard]] double softwareLatencyMs(const FrameStations& stations);
/// ms from the exposure; nothing where the source's clock isn't the steady one.
[[nodiscard]] std::optional<double> wholeLatencyMs(const FrameStations& stations);

}  // namespace slamscope::apps
