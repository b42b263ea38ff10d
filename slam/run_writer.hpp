// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "slam/compressed_text.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// Writes a run; the ending says how (`.jsonl`, `.jsonl.zst`; "-" is standard output, a line at a
/// time). The file appears, whole, with `finish`; without, nothing is left.
///
///   RunWriter writer("run.jsonl.zst", simulation.header());
///   writer.write(*snapshot);
///   writer.finish();
class RunWriter {
 public:
  RunWriter(const std::string& path, const RunHeader& header);

  void write(const Snapshot& snapshot);
  void finish();
  [[nodiscard]] std::uint64_t records() const { return records_; }

 private:
  TextOutput output_;
  std::string text_;
  std::uint64_t records_ = 0;
};

}  // namespace slamscope::slam
