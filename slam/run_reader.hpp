// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slam/compressed_text.hpp"
#include "slam/line_buffer.hpp"
#include "slam/run_decoder.hpp"

namespace slamscope::slam {

/// Reads a run record by record; memory does not grow with the length of the run.
///
///   RunReader reader("run.jsonl.zst");
///   while (auto snapshot = reader.next()) use(**snapshot);
///
/// Unreadable input throws std::runtime_error: "file:line: field: what was expected, …".
class RunReader {
 public:
  /// Reads the header too. Throws where the file is missing or empty, or its ending is unknown.
  explicit RunReader(std::string path);

  [[nodiscard]] std::optional<SnapshotPtr> next();

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] const RunHeader& header() const { return decoder_.header(); }
  /// What was lost or odd but could be read over: a last line that was cut off, equal stamps.
  /// Complete once `next` has returned nothing.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  [[nodiscard]] SnapshotPtr readRecord();
  [[nodiscard]] std::optional<std::string_view> nextLine();
  [[nodiscard]] SnapshotPtr lastLine();
  void finish();

  std::string path_;
  TextInput input_;
  LineBuffer lines_;
  RunDecoder decoder_;
  SnapshotPtr ahead_;  ///< read with the header already
  bool ended_ = false;
  std::vector<std::string> warnings_;
};

}  // namespace slamscope::slam
