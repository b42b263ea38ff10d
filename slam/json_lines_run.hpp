// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slam/compressed_text.hpp"
#include "slam/line_buffer.hpp"
#include "slam/run_decoder.hpp"
#include "slam/run_source.hpp"

namespace slamscope::slam {

/// A run as JSON lines, plain or compressed; memory does not grow with the length of the run.
/// Messages: "file:line: field: what was expected, …".
class JsonLinesRun : public RunSource {
 public:
  /// Reads the header too. Throws where the file is missing or empty.
  explicit JsonLinesRun(std::string path);

  [[nodiscard]] SnapshotPtr next() override;
  [[nodiscard]] const RunHeader& header() const override { return decoder_.header(); }
  [[nodiscard]] const std::vector<std::string>& warnings() const override { return warnings_; }

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
