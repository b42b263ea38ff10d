// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace slamscope::tracking {

class FrameSource;

/// What is asked of a camera. The driver may grant less: a size or pixel format that it changes is
/// an error (the calibration would not fit), a rate is taken as granted.
struct V4l2Options {
  int width = 1280, height = 720;  ///< px
  double fps = 30;                 ///< frames a second; 0: the driver's choice
  std::string
      pixel_format{};  ///< YUYV, MJPG or GREY; empty: the first of these that the camera has
  std::optional<int> focus{};  ///< fixed focus, driver's units; not given: left alone
  /// Fixed exposure; not given: the camera's own automatic, and then frames are stamped as if it
  /// were 0.
  std::optional<std::chrono::microseconds> exposure{};
  /// Rolling shutter: from the first row to the last. Global: 0.
  std::chrono::microseconds readout{0};
  std::chrono::milliseconds timeout{2000};  ///< without a frame for so long: error
};

/// Where the driver put its stamp in a frame's life.
enum class StampPoint { start_of_exposure, end_of_frame };

/// Middle of the exposure of the middle row, from the driver's stamp. UVC cameras stamp the start
/// of the first row's exposure: mid = stamp + (exposure + readout) / 2. Most others stamp the end
/// of the last row's read-out: mid = stamp − (exposure + readout) / 2.
[[nodiscard]] std::chrono::nanoseconds midExposure(std::chrono::nanoseconds stamp, StampPoint point,
                                                   std::chrono::nanoseconds exposure,
                                                   std::chrono::nanoseconds readout);

/// A camera through V4L2 (mmap streaming). Times are CLOCK_MONOTONIC, mid-exposure; `next` waits
/// for a frame and hands out the newest, older ones that waited in the driver are dropped (a gap in
/// `sequence`). Throws std::runtime_error: no such device, not a capture device, a size, format or
/// control that it doesn't have, no frame in time, unplugged.
[[nodiscard]] std::unique_ptr<FrameSource> openV4l2(const std::string& device,
                                                    const V4l2Options& options);

}  // namespace slamscope::tracking
