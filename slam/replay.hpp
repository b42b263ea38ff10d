// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>

#include "slam/run_reader.hpp"
#include "slam/subject.hpp"

namespace slamscope::slam {

/// Plays a recorded run: publishes its records in order, when told to.
///
///   Replay replay(RunReader("run.jsonl"));
///   auto subscription = replay.observe(show);
///   while (replay.step()) {}
class Replay : public Subject {
 public:
  explicit Replay(RunReader reader);

  /// Publishes the next record; false at the end. Throws as RunReader::next does.
  bool step();
  /// Publishes all records up to and including `time`; how many.
  std::size_t advanceTo(std::chrono::nanoseconds time);
  /// Time of the next record, nothing at the end.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> nextTime();
  [[nodiscard]] const RunReader& reader() const { return reader_; }

 private:
  [[nodiscard]] const SnapshotPtr& peek();

  RunReader reader_;
  SnapshotPtr ahead_;
};

}  // namespace slamscope::slam
