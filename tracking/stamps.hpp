// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace slamscope::tracking {

/// One line of stamps.csv.
struct FrameStamp {
  std::string file;               ///< name within the directory of the stamps
  std::chrono::nanoseconds time;  ///< middle of the exposure
};

/// Reads `file,time_s` (with that header; blank lines and lines that begin with # are passed over),
/// in the order of the file. Throws std::runtime_error naming file and line: a header that is not
/// that, a time that is no number, a time that does not increase, a name twice, no line at all.
[[nodiscard]] std::vector<FrameStamp> readStamps(const std::filesystem::path& file);

/// "frame9" before "frame10": runs of digits compare as numbers.
[[nodiscard]] bool naturalLess(const std::string& a, const std::string& b);

/// k / fps, to the nanosecond.
[[nodiscard]] std::chrono::nanoseconds timeAtRate(std::uint64_t k, double fps);

}  // namespace slamscope::tracking
