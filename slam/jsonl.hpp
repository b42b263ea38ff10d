// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// Lines that a run is made of: the header first, then one record a line.
///
///   {"format": "slamscope", "version": 1, "sensor": "range-bearing"}
///   {"time_s": 0.1, "event": "step", "pose": [0, 0, 0], "ids": [4], "features": [[1.0, 0.2]],
///    "covariance": [[0.01, 0, 0, 0, 0], ...]}
///
/// Numbers are written in the shortest form that reads back to the same bits; non-finite ones as
/// NaN, Infinity, -Infinity. The covariance is written packed (or as `covariance_diagonal` where
/// only that is known) with the `asymmetry` of the matrix it came from beside it, time as `time_s`
/// for people and `stamp_ns`, which is exact.
[[nodiscard]] std::string formatHeader(const RunHeader& header);
[[nodiscard]] std::string formatRecord(const Snapshot& snapshot);  ///< without the line's end
/// The same, appended to `line`, which is not cleared: lets a writer reuse its buffer.
void appendRecord(std::string& line, const Snapshot& snapshot);

/// Reads such lines, from whatever language wrote them: a scalar for a list of one, flat or nested
/// features and matrices, `NaN`, `Infinity` and `null` as numbers, `time_s` or `stamp_ns` (integer
/// or string of digits; wins where both are given), `covariance` packed, as ragged or full rows or
/// flat full matrix, or `covariance_diagonal` alone. Unknown keys are ignored. Keeps its buffers
/// between lines; not for use by two threads at once.
///
/// Both functions throw std::runtime_error with a text "field: what was expected, what was found"
/// for a line that can't be read. A NaN, an infinite or an absurd value is no error.
class LineParser {
 public:
  LineParser();
  ~LineParser();
  LineParser(LineParser&&) noexcept;
  LineParser& operator=(LineParser&&) noexcept;

  /// The header, or nothing where the line has no "format" (then it is a record).
  [[nodiscard]] std::optional<RunHeader> header(std::string_view line);
  /// `default_sequence` is used where the line gives none.
  [[nodiscard]] Snapshot record(std::string_view line, std::uint64_t default_sequence);

 private:
  struct Buffers;
  std::unique_ptr<Buffers> buffers_;
};

/// Whether the text ends inside of an object, list or string: a line that was cut off while it was
/// being written, as opposed to one that is whole but wrong.
[[nodiscard]] bool isCutOff(std::string_view line);

[[nodiscard]] std::string_view eventName(Event event);
[[nodiscard]] std::string_view sensorName(Sensor sensor);

}  // namespace slamscope::slam
