// SPDX-License-Identifier: MIT
#include "slam/recorder.hpp"

namespace slamscope::slam {

Recorder::Recorder(Subject& subject, const std::string& path, const RunHeader& header,
                   EventSet events)
    : writer_(path, header),
      subscription_(subject.observe(
          events, [this](const SnapshotPtr& snapshot) { writer_.write(*snapshot); })) {}

void Recorder::finish() {
  subscription_ = {};
  writer_.finish();
}

}  // namespace slamscope::slam
