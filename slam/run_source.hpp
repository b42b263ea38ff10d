// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// Where the records of a stored run come from: what each format implements, once. Everybody else
/// uses RunReader.
class RunSource {
 public:
  RunSource() = default;
  RunSource(const RunSource&) = delete;
  RunSource& operator=(const RunSource&) = delete;
  virtual ~RunSource() = default;

  /// The next record, nullptr at the end. Throws std::runtime_error for what can't be read.
  [[nodiscard]] virtual SnapshotPtr next() = 0;
  [[nodiscard]] virtual const RunHeader& header() const = 0;
  /// What was assumed, odd or lost; complete once `next` has returned nullptr.
  [[nodiscard]] virtual const std::vector<std::string>& warnings() const = 0;
};

/// The format follows from the ending of the name: `.jsonl`, `.jsonl.zst` (also pipes, and "-" for
/// standard input), `.npz` and `.npy` (NumPy), `.mat` (MATLAB, Octave), or a directory that MRPT's
/// kf-slam wrote. Throws std::runtime_error where the file is missing, its ending unknown or its
/// beginning unreadable.
[[nodiscard]] std::unique_ptr<RunSource> openRun(const std::string& path);

}  // namespace slamscope::slam
