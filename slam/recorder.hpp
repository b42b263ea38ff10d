// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "slam/run_writer.hpp"
#include "slam/subject.hpp"

namespace slamscope::slam {

/// `--record steps`: one record per time step at which something was observed.
inline constexpr EventSet kRecordSteps{Event::initial, Event::step};
/// `--record all`: every prediction, update, initialisation and removal (level L2 of the audit).
inline constexpr EventSet kRecordAll{Event::initial, Event::predict, Event::update,
                                     Event::initialise, Event::remove};

/// Observes a subject and writes what it publishes as a run, until it is finished or destroyed.
///
///   Recorder recorder(filter, "run.jsonl", header, kRecordSteps);
///   …
///   recorder.finish();
class Recorder {
 public:
  Recorder(Subject& subject, const std::string& path, const RunHeader& header,
           EventSet events = kRecordSteps);
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Stops observing and puts the file in its place. Without it, nothing is left.
  void finish();
  [[nodiscard]] std::uint64_t records() const { return writer_.records(); }

 private:
  RunWriter writer_;
  Subscription subscription_;
};

}  // namespace slamscope::slam
