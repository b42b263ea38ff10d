// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slam/run_source.hpp"

namespace slamscope::slam {

/// Reads a run, of whatever format (openRun), record by record.
///
///   RunReader reader("run.jsonl.zst");
///   while (auto snapshot = reader.next()) use(**snapshot);
///
/// Unreadable input throws std::runtime_error: "file:line: field: what was expected, …".
class RunReader {
 public:
  /// Throws as openRun does.
  explicit RunReader(std::string path) : path_(std::move(path)), source_(openRun(path_)) {}

  [[nodiscard]] std::optional<SnapshotPtr> next() {
    SnapshotPtr snapshot = source_->next();
    if (!snapshot) return std::nullopt;
    return snapshot;
  }

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] const RunHeader& header() const { return source_->header(); }
  /// What was assumed, lost or odd but could be read over: a last line that was cut off, equal
  /// stamps, times that nobody wrote. Complete once `next` has returned nothing.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return source_->warnings(); }

 private:
  std::string path_;
  std::unique_ptr<RunSource> source_;
};

}  // namespace slamscope::slam
