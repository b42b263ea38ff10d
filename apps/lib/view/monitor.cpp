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
  state_->choices.message = whatIsAt(pixel, state_->picture.scene, *state_->layer.newest(),
                                     state_->picture.view, state_->setup.map_scale);
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
Monitor::Choices& Monitor::choices() {
  return state_->choices;
}

bool Monitor::paced() const {
  return !state_->setup.source->live() && (state_->options.window || state_->layer.feed().live());
}
double Monitor::secondsShown() const {
  return state_->first_time ? seconds(state_->frame_time - *state_->first_time) : 0.0;
}
double Monitor::frameSeconds() const {
  return seconds(state_->frame_step);
}
std::uint64_t Monitor::framesShown() const {
  return state_->frame_count;
}
double Monitor::progress() const {
  const State& state = *state_;
  if (state.options.frames > 0) {
    return static_cast<double>(state.frame_count) / static_cast<double>(state.options.frames);
  }
  if (const auto count = state.setup.source->count(); count && *count > 0) {
    return static_cast<double>(state.frame_count) / static_cast<double>(*count);
  }
  if (!state.truth) return -1.0;
  return state.layer.progress(*state.truth);
}
std::string Monitor::status() const {
  return state_->registration.status();
}
const std::vector<std::string>& Monitor::notes() const {
  return state_->setup.notes;
}
const std::shared_ptr<engine::Gpu>& Monitor::gpu() const {
  return state_->gpu;
}

}  // namespace slamscope::apps
