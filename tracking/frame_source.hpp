// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "tracking/camera_info.hpp"
#include "tracking/frame.hpp"
#include "tracking/v4l2_source.hpp"

namespace slamscope::tracking {

/// Anything that hands out frames one after the other: files, a camera, the synthetic lab.
/// All frames of a source are of one size; their times increase strictly.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next frame, or nothing at the end. Throws std::runtime_error, one line, where a frame that
  /// should be there can't be had: unreadable picture, another size, camera unplugged.
  [[nodiscard]] virtual std::optional<Frame> next() = 0;

  /// Passes over frames that nobody will look at. A source that makes its frames needs no time.
  virtual void skip(std::uint64_t frames) {
    while (frames-- > 0 && next()) {
    }
  }

  /// Intrinsics, where the source knows its own (the lab does; files and devices don't).
  [[nodiscard]] virtual std::optional<CameraInfo> cameraInfo() const { return std::nullopt; }
  /// Frames come at the world's pace and are lost when nobody asks (a camera).
  [[nodiscard]] virtual bool live() const { return false; }
  /// Times come from a clock (stamps.csv, a video's own, a camera's, the lab's). Otherwise they are
  /// counted from zero at a frame rate, and mean nothing beside a run with stamps.
  [[nodiscard]] virtual bool stamped() const { return true; }
  /// Frames in all, where that is known beforehand.
  [[nodiscard]] virtual std::optional<std::uint64_t> count() const { return std::nullopt; }
};

struct FrameSourceOptions {
  /// Frames a second. Given, it overrides stamps.csv and a video's own clock (and stamped() is
  /// false); 0: not given, and where there is no clock either, 30.
  double fps = 0;
  V4l2Options v4l2 = {};  ///< for a device
};

/// Opens what `spec` names: a directory of images (in natural order: frame9 before frame10), a
/// pattern
/// (`dir/img-%05d.png`), one image, a video file, or a V4L2 device (`/dev/video0`, or `0` for
/// short). A stamps.csv (`file,time_s`) in the directory gives times, and names the frames that
/// belong to it. Throws std::runtime_error, one line: no such file, no image in the directory, not
/// a capture device…
[[nodiscard]] std::unique_ptr<FrameSource> openFrameSource(const std::string& spec,
                                                           const FrameSourceOptions& options = {});

}  // namespace slamscope::tracking
