// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "engine/scene/view.hpp"

namespace slamscope::apps {

/// Where drawn pictures go, one write() a frame. Files appear under their own name only when whole.
class PictureOutput {
 public:
  virtual ~PictureOutput() = default;
  /// Throws std::runtime_error when the picture can't be written or has another size than the
  /// first.
  virtual void write(const engine::Image& picture) = 0;
  /// Closes the output; without it a video is left under a temporary name that is then removed.
  virtual void finish() = 0;
};

/// Opens by ending: `NAME.mp4`, or `NAME-%05d.png` (numbered from 0). Throws std::runtime_error for
/// another ending, a pattern without a number, or a folder that doesn't exist.
[[nodiscard]] std::unique_ptr<PictureOutput> openPictureOutput(const std::filesystem::path& target,
                                                               double frames_per_second);

/// One picture, NAME.png or NAME.jpg. Throws std::runtime_error when it can't be written.
void writePicture(const std::filesystem::path& file, const engine::Image& picture);

/// Two pictures of one height side by side, with a gap of white columns.
[[nodiscard]] engine::Image sideBySide(const engine::Image& left, const engine::Image& right,
                                       int gap_px = 12);

}  // namespace slamscope::apps
