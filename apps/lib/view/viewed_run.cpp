// SPDX-License-Identifier: MIT
#include "apps/lib/view/viewed_run.hpp"

#include <utility>

namespace slamscope::apps {

ViewedRun::ViewedRun(const MonitorOptions& request)
    : options(request),
      truth(truthFor(request)),
      choices(choicesOf(request)),
      gpu(gpuFor(request)),
      layer(options, choices, gpu) {}

void ViewedRun::arrive(std::chrono::nanoseconds time, bool stamped) {
  if (!first_time) {
    first_time = time;
    if (auto note = layer.begin(time, stamped)) notes.push_back(std::move(*note));
  }
  if (frame_count > 0) frame_step = time - frame_time;
  frame_time = time;
  ++frame_count;
}

}  // namespace slamscope::apps
