// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "slam/jsonl.hpp"
#include "slam/run_order.hpp"

namespace slamscope::slam {

/// Turns the lines of one run into snapshots, one by one, and holds the run to its order
/// (RunOrder). What breaks that is unreadable (std::runtime_error, "source:line: field: what was
/// expected, what was found") and leaves the state as it was.
/// The header may be missing: the first line is then a record.
class RunDecoder {
 public:
  /// Whether a header or an `initial` record in the middle begins another run (in a live stream, a
  /// filter that was started again) or is an error (in a file).
  enum class Runs { one, many };

  /// `source` names the run in messages.
  explicit RunDecoder(std::string source, Runs allowed = Runs::one);

  /// The record in this line, or nullptr for the header and for blank lines.
  [[nodiscard]] SnapshotPtr decode(std::string_view line);

  [[nodiscard]] const RunHeader& header() const { return header_; }
  [[nodiscard]] bool begun() const { return begun_; }           ///< header or first record was read
  [[nodiscard]] std::uint64_t lines() const { return lines_; }  ///< seen so far
  [[nodiscard]] std::uint64_t records() const { return records_; }  ///< read so far
  /// As RunOrder::equalStamps.
  [[nodiscard]] std::uint64_t equalStamps() const { return order_.equalStamps(); }
  [[nodiscard]] std::uint64_t runs() const { return runs_; }

 private:
  void begin(const RunHeader& header);

  std::string source_;
  Runs allowed_;
  LineParser parser_;
  RunHeader header_;
  RunOrder order_;
  bool begun_ = false;  ///< header or first record seen
  std::uint64_t runs_ = 0;
  std::uint64_t lines_ = 0;
  std::uint64_t records_ = 0;
  std::uint64_t run_records_ = 0;  ///< of this run
};

}  // namespace slamscope::slam
