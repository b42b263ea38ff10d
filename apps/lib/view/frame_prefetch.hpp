// SPDX-License-Identifier: MIT
#pragma once

#include <future>
#include <memory>
#include <optional>

#include "tracking/frame_source.hpp"

namespace slamscope::apps {

/// Gets the next frame on a thread of its own while this one is worked on. Frames, their order and
/// their errors are those of the source.
class FramePrefetch {
 public:
  explicit FramePrefetch(tracking::FrameSource& source) : source_(source) {}

  [[nodiscard]] std::optional<tracking::Frame> next() {
    std::optional<tracking::Frame> frame = ahead_.valid() ? ahead_.get() : source_.next();
    if (frame) ahead_ = std::async(std::launch::async, [this] { return source_.next(); });
    return frame;
  }

  /// Passes over the next `frames`.
  void skip(std::uint64_t frames) {
    if (frames == 0) return;
    if (ahead_.valid()) static_cast<void>(ahead_.get()), --frames;
    source_.skip(frames);
  }

 private:
  tracking::FrameSource& source_;
  std::future<std::optional<tracking::Frame>> ahead_;  // last member: its destructor waits
};

}  // namespace slamscope::apps
