// SPDX-License-Identifier: MIT
#include "apps/lib/view/hmd.hpp"

#include <algorithm>
#include <cstdio>

#include "apps/lib/view/hmd_state.hpp"

namespace slamscope::apps {

Hmd::State::State(const HmdOptions& asked)
    : ViewedRun(asked.view),
      request(asked),
      setup(openStereo(asked, truth)),
      head(setup, registrationPairs()),
      pairs(setup),
      picture(gpu, head.rig(),
              {.width = options.width,
               .height = options.height,
               .layout = request.layout,
               .swap_eyes = request.swap_eyes}) {
  live_frames = setup.source->live();
  source_frames = setup.source->count();
  notes = setup.notes;
  if (!options.output.empty()) output = openPictureOutput(options.output, setup.fps);
  if (!asked.latency.empty()) latency.emplace(asked.latency);
}

int Hmd::State::registrationPairs() const {
  constexpr std::uint64_t kPairs = 30;
  std::uint64_t count = setup.source->count().value_or(0);
  const std::uint64_t asked = options.frames;
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
  if (options.frames > 0 && frame_count >= options.frames) return false;
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
  arrive(head.time(), setup.source->stamped());
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
void Hmd::explain(const Eigen::Vector2d& pixel) {
  state_->explain(pixel);
}
void Hmd::finish(Ending ending) {
  state_->finish(ending);
}
const engine::Image& Hmd::drawn() const {
  return state_->picture.drawn();
}
std::string Hmd::status() const {
  std::string all;
  for (const std::string& line : state_->head.statusLines()) {
    all += (all.empty() ? "" : " · ") + line;
  }
  return all;
}
ViewedRun& Hmd::run() {
  return *state_;
}
const ViewedRun& Hmd::run() const {
  return *state_;
}

}  // namespace slamscope::apps
