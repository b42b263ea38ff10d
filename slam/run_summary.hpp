// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "slam/run_reader.hpp"

namespace slamscope::slam {

/// What a log contains, and so what can be proved from it. L4 is any of these plus the truth:
/// RunSummary::truth.
enum class RunLevel { LC, L0, L1, L2, L3 };

/// What is in a run (`slamscope info`).
struct RunSummary {
  RunHeader header;
  std::uint64_t records = 0;
  std::uint64_t steps = 0;                ///< different times
  std::array<std::uint64_t, 6> events{};  ///< records by Event
  int features_at_end = 0;                ///< in the last record
  int features_at_most = 0;
  std::uint64_t different_features = 0;  ///< ids seen over the run
  std::vector<std::string> extra;        ///< names of further states
  std::chrono::nanoseconds first{}, last{};
  RunLevel level = RunLevel::L1;
  bool truth = false;                             ///< some record carries the truth (L4)
  bool observed = false;                          ///< some record says what was observed
  std::optional<double> worst_asymmetry;          ///< of full matrices; absent for triangles
  std::optional<std::uint64_t> first_not_finite;  ///< number of the record, from 0
  std::vector<std::string> warnings;

  [[nodiscard]] std::chrono::nanoseconds duration() const { return last - first; }
  [[nodiscard]] std::uint64_t count(Event event) const {
    return events[static_cast<std::size_t>(event)];
  }
  /// "L2", or "L2, with truth (L4)".
  [[nodiscard]] std::string levelName() const;
};

/// Reads the run to its end.
[[nodiscard]] RunSummary summarize(RunReader& reader);

}  // namespace slamscope::slam
