// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace slamscope::testing {

/// A UVC camera as programs meet it through V4L2: it answers this process's open, ioctl, poll and
/// close of one path, all other calls go on to the system. Time is its own: a frame is there
/// whenever somebody waits for one.
struct FakeCamera {
  using Bytes = std::vector<std::uint8_t>;

  std::vector<std::uint32_t> formats;  ///< that it offers (V4L2_PIX_FMT_…); the first is its own
  int width = 640, height = 480;       ///< the only size it has
  std::map<std::uint32_t, int> controls{};  ///< id and value; others are refused (EINVAL)
  /// What it sends: frame `sequence` in a format.
  std::function<Bytes(std::uint32_t sequence, std::uint32_t format)> picture;
  std::int64_t interval_us = 33'333;
  bool stamps_start = true;   ///< of the exposure, as uvcvideo does; false: end of the frame
  bool captures = true;       ///< false: an output device
  bool busy = false;          ///< somebody else streams
  bool plugged = true;        ///< false: ENODEV, and gone from /dev
  bool silent = false;        ///< sends nothing any more
  int ready_at_once = 1;      ///< frames that wait when somebody looks
  std::uint32_t damaged = 0;  ///< so many frames to come bear V4L2_BUF_FLAG_ERROR

  std::uint32_t next_sequence = 0;
  int opened = 0;  ///< how often
};

/// The camera of a path such as /dev/video90; made when first asked for. Not for several threads,
/// but what the program under test does with it on its own threads is guarded.
FakeCamera& fakeCamera(const std::string& path);
/// Takes all fake cameras away.
void unplugFakeCameras();

}  // namespace slamscope::testing
