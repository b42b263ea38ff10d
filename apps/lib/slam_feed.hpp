// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "slam/simulation.hpp"
#include "slam/subject.hpp"

namespace slamscope::apps {

/// Where a viewer's snapshots come from: a recorded run, a simulation, or a filter that runs now.
class SlamFeed {
 public:
  virtual ~SlamFeed() = default;

  /// What to observe.
  [[nodiscard]] virtual slam::Subject& subject() = 0;
  /// Publishes what is due: the records up to and including `time` of the run; of a live filter
  /// whatever has arrived. Throws std::runtime_error where a recorded run can't be read on.
  virtual void advanceTo(std::chrono::nanoseconds time) = 0;
  /// Time of the first record; nothing for a live filter.
  [[nodiscard]] virtual std::optional<std::chrono::nanoseconds> start() const = 0;
  /// Nothing more will come.
  [[nodiscard]] virtual bool ended() const = 0;
  /// Comes at the world's pace, with a clock of its own.
  [[nodiscard]] bool live() const { return !start().has_value(); }
  /// Grows when a source came back or began a new run: what was remembered of the last is dropped.
  [[nodiscard]] virtual std::uint64_t runs() const { return 1; }
  /// What the current run says of itself.
  [[nodiscard]] virtual const slam::RunHeader& header() const = 0;
  /// For the status line: "waiting on 127.0.0.1:7007 for a filter"; empty when there is nothing to
  /// say.
  [[nodiscard]] virtual std::string status() const { return {}; }
};

/// `simulate` (as `simulation` says), `laser-lab` (loops and seed as it says), `-`,
/// `tcp://HOST:PORT`, or a run by its path. Throws std::runtime_error where it can't be opened.
[[nodiscard]] std::unique_ptr<SlamFeed> openSlamFeed(const std::string& spec,
                                                     const slam::SimulationOptions& simulation);

}  // namespace slamscope::apps
