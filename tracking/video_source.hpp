// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

namespace slamscope::tracking {

class FrameSource;

/// A video file, with the times of its own clock, or k / fps where fps is given (> 0). Throws
/// std::runtime_error where the file is no video that FFmpeg reads.
[[nodiscard]] std::unique_ptr<FrameSource> openVideo(const std::filesystem::path& file, double fps);

}  // namespace slamscope::tracking
