// SPDX-License-Identifier: MIT
#include "apps/lib/view/stereo_setup.hpp"

#include <stdexcept>
#include <utility>

#include "apps/lib/view/camera_setup.hpp"

namespace slamscope::apps {
namespace {

using tracking::StereoFrame;

tracking::HeadPath headPath(const std::string& name) {
  if (name == "stand") return tracking::standingHead();
  if (name == "walk") return tracking::walkingHead();
  if (name == "turn") return tracking::turningHead();
  return tracking::wanderingHead();
}

void openStereoLab(StereoSetup& setup, const HmdOptions& options,
                   const std::optional<RunTruth>& truth) {
  tracking::StereoLabOptions lab = tracking::defaultStereoLab();
  if (options.view.fps > 0.0) lab.room.fps = options.view.fps;
  lab.room.frames = options.view.frames;
  lab.room.seed = options.view.lab_seed;
  // The paths start at time 0, a run when it likes.
  LabPlacement placed = placeInLab(lab.room, options.view, truth);
  lab.head = [path = headPath(options.walk), start = lab.room.start](auto time) {
    return path(time - start);
  };
  setup.map_scale = placed.map_scale;
  setup.notes = std::move(placed.notes);
  setup.fps = lab.room.fps;
  setup.robot = tracking::RobotTag{.id = lab.room.robot_tag_id,
                                   .size_m = lab.room.robot_tag_size,
                                   .T_robot_tag = lab.room.T_robot_tag};
  auto source = std::make_unique<tracking::StereoLab>(std::move(lab));
  setup.lab = source.get();
  setup.source = std::move(source);
}

void openRealEyes(StereoSetup& setup, const HmdOptions& options) {
  const MonitorOptions& view = options.view;
  setup.source = tracking::openStereoSource(view.camera, {.fps = view.fps, .v4l2 = view.v4l2});
  setup.map_scale = view.map_scale.value_or(1.0);
  while (setup.ahead.size() < 2) {
    auto pair = setup.source->next();
    if (!pair) break;
    setup.ahead.push_back(std::move(*pair));
  }
  if (setup.ahead.empty()) throw std::runtime_error(view.camera + ": no frame in it");
  if (setup.ahead.size() < 2) return;
  for (const std::size_t eye : {0U, 1U}) {
    const auto& before = setup.ahead[0].eyes[eye];
    const auto& after = setup.ahead[1].eyes[eye];
    if (!before || !after) continue;
    setup.fps = 1.0 / std::chrono::duration<double>(after->time - before->time).count();
    return;
  }
}

void chooseRig(StereoSetup& setup, const HmdOptions& options) {
  const std::size_t cameras = setup.source->cameras();
  if (!options.rig.empty()) {
    setup.rig = tracking::readRig(options.rig);
    if (setup.rig.cameras.size() < cameras) {
      throw std::runtime_error(options.rig.string() + ": it has one camera, " +
                               options.view.camera + " has two");
    }
  } else if (auto own = setup.source->rig()) {
    setup.rig = std::move(*own);
  } else {
    const StereoFrame& first = setup.ahead.front();
    const auto& frame = first.eyes[0] ? first.eyes[0] : first.eyes[1];
    setup.rig = tracking::guessedRig(frame->width, frame->height, cameras);
    setup.notes.emplace_back("no --rig: cameras are guessed, the picture is uncalibrated");
  }
  for (std::size_t eye = 0; eye < cameras && !setup.ahead.empty(); ++eye) {
    const auto& frame = setup.ahead.front().eyes[eye];
    if (frame) tracking::requireSize(setup.rig.cameras[eye].info, frame->width, frame->height);
  }
  if (cameras == 1) {
    setup.notes.emplace_back(
        "one camera: its picture goes to the left eye, the overlay to both; the right eye stands "
        "before black");
  }
}

void chooseTags(StereoSetup& setup, const HmdOptions& options) {
  const MonitorOptions& view = options.view;
  if (!view.robot.empty() && view.robot != "none") setup.robot = tracking::readRobotTag(view.robot);
  if (view.robot == "none") setup.robot.reset();
  if (!view.tags.empty()) {
    setup.tags = tracking::readTagLayout(view.tags);
  } else if (auto own = setup.source->tags()) {
    setup.tags = std::move(*own);
  } else {
    // One tag is all there is: the map starts under it, and it must not move.
    const tracking::RobotTag one = setup.robot.value_or(tracking::RobotTag{});
    setup.tags = {.family = one.family, .tags = {{one.id, one.size_m, one.T_robot_tag}}};
    setup.robot.reset();
    setup.tags_known = false;
    setup.notes.emplace_back("no --tags: tag " + std::to_string(one.id) +
                             " alone says where the head is; it must not move");
    return;
  }
  if (!setup.robot) {
    setup.notes.emplace_back(
        "no --robot: the map starts at the origin of the tags' world, x ahead");
  }
}

}  // namespace

StereoSetup openStereo(const HmdOptions& options, const std::optional<RunTruth>& truth) {
  StereoSetup setup;
  if (options.view.camera == "lab") {
    openStereoLab(setup, options, truth);
  } else {
    openRealEyes(setup, options);
  }
  chooseRig(setup, options);
  chooseTags(setup, options);
  return setup;
}

tracking::Rig drawnRig(const tracking::Rig& rig) {
  tracking::Rig eyes = rig;
  if (eyes.cameras.size() == 2) return eyes;
  eyes.cameras.push_back(eyes.cameras.front());
  if (eyes.baseline() == 0.0) {
    eyes.T_right_left = tracking::guessedRig(2, 2, 2).T_right_left;
  }
  return eyes;
}

std::optional<TakenPair> PairPrefetch::take() {
  auto frame = setup_.source->next();
  if (!frame) return std::nullopt;
  return TakenPair{std::move(*frame), std::chrono::steady_clock::now(), setup_.source->problems()};
}

std::optional<TakenPair> PairPrefetch::next() {
  if (!setup_.ahead.empty()) {
    TakenPair pair{std::move(setup_.ahead.front()), std::chrono::steady_clock::now(), {}};
    setup_.ahead.pop_front();
    return pair;
  }
  auto pair = ahead_.valid() ? ahead_.get() : take();
  if (pair) ahead_ = std::async(std::launch::async, [this] { return take(); });
  return pair;
}

}  // namespace slamscope::apps
