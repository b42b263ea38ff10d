// SPDX-License-Identifier: MIT
#include "apps/lib/view/monitor.hpp"

#include "apps/lib/view/monitor_state.hpp"
#include "apps/lib/view/picked_glyph.hpp"

namespace slamscope::apps {

Monitor::Monitor(const MonitorOptions& options) : state_(std::make_unique<State>(options)) {}
Monitor::~Monitor() = default;

bool Monitor::next() {
  return state_->next();
}
void Monitor::draw() {
  state_->draw();
}
void Monitor::explain(const Eigen::Vector2d& pixel) {
  if (!state_->shown()) return;
  state_->choices.message = whatIsAt(pixel, 0,
                                     {.offscreen = state_->offscreen,
                                      .scene = state_->picture.scene,
                                      .snapshot = *state_->layer.newest(),
                                      .alarms = state_->layer.alarms()});
}
void Monitor::finish(Ending ending) {
  state_->finish(ending);
}
const Monitor::Picture& Monitor::picture() const {
  return state_->picture;
}
const engine::Image& Monitor::drawn() const {
  return state_->pixels.front();
}
std::string Monitor::status() const {
  return state_->registration.status();
}
ViewedRun& Monitor::run() {
  return *state_;
}
const ViewedRun& Monitor::run() const {
  return *state_;
}

}  // namespace slamscope::apps
