// SPDX-License-Identifier: MIT
#include "apps/lib/view/hmd.hpp"

#include <algorithm>
#include <cstdio>

#include "apps/lib/view/hmd_state.hpp"
#include "engine/window/window.hpp"

namespace slamscope::apps {
namespace {

using slam::seconds;

std::shared_ptr<engine::Gpu> gpuFor(const MonitorOptions& view) {
  return std::make_shared<engine::Gpu>(
      engine::GpuOptions{.device = view.device,
                         .validation = view.validation,
                         .instance_extensions = view.window ? engine::windowInstanceExtensions()
                                                            : std::vector<std::string>{}});
}

}  // namespace

Hmd::State::State(const HmdOptions& request)
    : options(request),
      truth(truthFor(request.view)),
      setup(openStereo(request, truth)),
      choices(choicesOf(request.view)),
      layer(options.view, choices),
      head(setup, registrationPairs()),
      pairs(setup),
      gpu(gpuFor(request.view)),
      picture(gpu, head.rig(),
              {.width = request.view.width,
               .height = request.view.height,
               .layout = request.layout,
               .swap_eyes = request.swap_eyes}) {
  if (!request.view.output.empty()) output = openPictureOutput(request.view.output, setup.fps);
  if (!request.latency.empty()) latency.emplace(request.latency);
}

int Hmd::State::registrationPairs() const {
  constexpr std::uint64_t kPairs = 30;
  std::uint64_t count = setup.source->count().value_or(0);
  const std::uint64_t asked = options.view.frames;
  if (asked > 0) count = count > 0 ? std::min(count, asked) : asked;
  // A short film can't spend thirty frames on standing still.
  return static_cast<int>(count > 0 ? std::clamp<std::uint64_t>((count + 1) / 2, 1, kPairs)
                                    : kPairs);
}

bool Hmd::State::runIsOver() const {
  return setup.lab != nullptr && layer.feed().ended() &&
         (head.place() || layer.newest() == nullptr);
}

bool Hmd::State::next() {
  if (options.view.frames > 0 && frame_count >= options.view.frames) return false;
  if (frame_count > 0 && runIsOver()) return false;
  StopWatch watch;
  const std::optional<TakenPair> pair = pairs.next();
  if (!pair) return false;
  report.addStage("frame", watch.lap());
  head.add(pair->frame);
  report.addStage("track", watch.lap());
  stations = {.mid_exposure = head.time(),
              .dequeued = pair->dequeued,
              .pose = std::chrono::steady_clock::now(),
              .presented = {}};
  problems = pair->problems;
  for (std::string& problem : head.problems()) problems.push_back(std::move(problem));
  if (!first_time) {
    first_time = head.time();
    if (auto note = layer.begin(*first_time, setup.source->stamped())) {
      setup.notes.push_back(std::move(*note));
    }
  }
  if (frame_count > 0) frame_step = head.time() - frame_time;
  frame_time = head.time();
  ++frame_count;
  layer.advance(frame_time);
  report.addStage("slam", watch.lap());
  layer.judge();
  report.addStage("audit", watch.lap());
  picture.takeFrames(pair->frame);
  report.addStage("background", watch.lap());
  return true;
}

std::vector<std::string> Hmd::State::lines() const {
  std::vector<std::string> lines = head.statusLines();
  if (latency_ms) {
    char text[64];
    std::snprintf(text, sizeof text, "camera to picture %.0f ms", *latency_ms);
    lines.emplace_back(text);
  }
  for (const std::string& problem : problems) lines.push_back(problem);
  if (head.rig().cameras.size() > setup.source->cameras()) {
    lines.emplace_back("one camera: its picture goes to the left eye, the overlay to both");
  }
  return lines;
}

void Hmd::State::compose() {
  render.opacity = static_cast<float>(choices.opacity);
  const auto& eyes = head.eyes();
  auto& views = picture.views();
  std::optional<SlamLayer::Place> place;
  if (eyes[0].T_eye_map && eyes[1].T_eye_map) {
    for (std::size_t eye = 0; eye < views.size(); ++eye) {
      views[eye].T_eye_scene = *eyes[eye].T_eye_map;
    }
    if (!ever_shown) {
      ever_shown = true;
      metres_per_px = views[0].T_eye_scene.translation().norm() / views[0].camera.fx;
    }
    place.emplace(SlamLayer::Place{.view = views[0],
                                   .map_scale = setup.map_scale,
                                   .metres_per_px = metres_per_px,
                                   .viewer_up = Eigen::Vector3d::UnitZ(),
                                   .own_error = [this](const Eigen::Vector3d& p_scene) {
                                     return head.ownErrorOnFloor(p_scene);
                                   }});
  }
  scene = layer.compose(place, views[0].camera, lines());
}

Hmd::Hmd(const HmdOptions& options) : state_(std::make_unique<State>(options)) {}
Hmd::~Hmd() = default;

bool Hmd::next() {
  return state_->next();
}
void Hmd::draw() {
  state_->draw();
}
void Hmd::finish(Ending ending) {
  state_->finish(ending);
}
const engine::Image& Hmd::drawn() const {
  return state_->picture.drawn();
}
Viewer::Choices& Hmd::choices() {
  return state_->choices;
}
bool Hmd::paced() const {
  return !state_->setup.source->live() &&
         (state_->options.view.window || state_->layer.feed().live());
}
double Hmd::secondsShown() const {
  return state_->first_time ? seconds(state_->frame_time - *state_->first_time) : 0.0;
}
double Hmd::frameSeconds() const {
  return seconds(state_->frame_step);
}
std::uint64_t Hmd::framesShown() const {
  return state_->frame_count;
}
double Hmd::progress() const {
  const auto shown = static_cast<double>(state_->frame_count);
  const std::uint64_t count = state_->options.view.frames > 0
                                  ? state_->options.view.frames
                                  : state_->setup.source->count().value_or(0);
  if (count > 0) return shown / static_cast<double>(count);
  return state_->truth ? state_->layer.progress(*state_->truth) : -1.0;
}
std::string Hmd::status() const {
  std::string all;
  for (const std::string& line : state_->head.statusLines()) {
    all += (all.empty() ? "" : " · ") + line;
  }
  return all;
}
const std::vector<std::string>& Hmd::notes() const {
  return state_->setup.notes;
}
const std::shared_ptr<engine::Gpu>& Hmd::gpu() const {
  return state_->gpu;
}

}  // namespace slamscope::apps
