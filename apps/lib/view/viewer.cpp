// SPDX-License-Identifier: MIT
#include "apps/lib/view/viewer.hpp"

#include "apps/lib/view/viewed_run.hpp"

namespace slamscope::apps {

using slam::seconds;

Viewer::Choices& Viewer::choices() {
  return run().choices;
}
bool Viewer::paced() const {
  return !run().live_frames && (run().options.window || run().layer.feed().live());
}
double Viewer::secondsShown() const {
  return run().first_time ? seconds(run().frame_time - *run().first_time) : 0.0;
}
double Viewer::frameSeconds() const {
  return seconds(run().frame_step);
}
std::uint64_t Viewer::framesShown() const {
  return run().frame_count;
}
double Viewer::progress() const {
  const ViewedRun& shown = run();
  const std::uint64_t asked = shown.options.frames;
  const std::uint64_t count = asked > 0 ? asked : shown.source_frames.value_or(0);
  if (count > 0) return static_cast<double>(shown.frame_count) / static_cast<double>(count);
  return shown.truth ? shown.layer.progress(*shown.truth) : -1.0;
}
const std::vector<std::string>& Viewer::notes() const {
  return run().notes;
}
const std::shared_ptr<engine::Gpu>& Viewer::gpu() const {
  return run().gpu;
}

}  // namespace slamscope::apps
