// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cmath>
#include <string>

namespace slamscope::apps {

/// From a frame's time to the run's. Frames and run that were stamped by one clock stay as they
/// are; else the first frame is laid on the run's start.
class RunClock {
 public:
  using nanoseconds = std::chrono::nanoseconds;

  struct Description {
    nanoseconds run_start{};
    nanoseconds first_frame{};
    bool frames_stamped = false;
    double rate = 1.0;     ///< seconds of the run per second of the camera
    nanoseconds offset{};  ///< added to a frame's time
  };

  /// Stamps further apart than this come from different clocks.
  static constexpr nanoseconds kSameClock = std::chrono::hours(1);

  RunClock() = default;
  explicit RunClock(const Description& about)
      : run_start_(about.run_start),
        same_clock_(about.frames_stamped &&
                    std::chrono::abs(about.first_frame - about.run_start) < kSameClock),
        origin_(same_clock_ ? about.run_start : about.first_frame),
        rate_(about.rate),
        offset_(about.offset) {}

  [[nodiscard]] nanoseconds runTime(nanoseconds frame) const {
    const auto since = static_cast<double>((frame + offset_ - origin_).count());
    return run_start_ + nanoseconds(std::llround(rate_ * since));
  }
  [[nodiscard]] bool sameClock() const { return same_clock_; }

 private:
  nanoseconds run_start_{};
  bool same_clock_ = true;
  nanoseconds origin_{};
  double rate_ = 1.0;
  nanoseconds offset_{};
};

}  // namespace slamscope::apps
