// SPDX-License-Identifier: MIT
#include "tracking/stereo_lab.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tracking/lab_sensor.hpp"
#include "tracking/lab_walk_painter.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Vector2d, Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr int kWalkPoses = 65;  // during one exposure and read-out

StereoLabOptions checkedStereo(StereoLabOptions options) {
  const auto require = [](bool met, const char* what) {
    if (!met) throw std::invalid_argument(std::string("stereo lab: ") + what);
  };
  require(options.rig.cameras.size() == 1 || options.rig.cameras.size() == 2,
          "a rig of one camera or two is expected");
  require(static_cast<bool>(options.head), "a path of the head is expected");
  require(options.room.fps > 0, "frames a second must be more than 0");
  require(options.room.exposure.count() >= 0, "exposure can't be negative");
  require(options.light > 0, "light must be more than 0");
  for (const RigCamera& camera : options.rig.cameras) {
    require(camera.readout.count() >= 0, "readout can't be negative");
  }
  return options;
}

LabOptions asSeenBy(const StereoLabOptions& options, std::size_t eye) {
  LabOptions room = options.room;
  room.camera = options.rig.cameras[eye].info;
  room.seed = 2 * room.seed + eye;  // noise of its own
  return room;
}

}  // namespace

struct StereoLab::Parts {
  struct Eye {
    Eye(const StereoLabOptions& options, std::size_t index, const lab::Room& room,
        const lab::Robot& robot)
        : painter(options.rig.cameras[index].info, room, robot), sensor(asSeenBy(options, index)) {}

    lab::WalkPainter painter;
    lab::Sensor sensor;
    // What was painted last: a head on a tripod sees it again.
    std::optional<lab::WalkMotion> motion;
    lab::Canvas exposed;
  };

  explicit Parts(const StereoLabOptions& options) : room(options.room), robot(options.room) {
    for (std::size_t i = 0; i < options.rig.cameras.size(); ++i) {
      eyes.push_back(std::make_unique<Eye>(options, i, room, robot));
    }
  }

  const lab::Canvas& expose(std::size_t eye, lab::WalkMotion motion, double light) {
    Eye& one = *eyes[eye];
    if (one.motion && *one.motion == motion) return one.exposed;
    lab::Canvas canvas = one.painter.paint(motion);
    for (Eigen::Array3f& pixel : canvas.pixels) pixel *= static_cast<float>(light);
    one.exposed = canvas;
    one.sensor.expose(canvas, {0, 0, canvas.width, canvas.height}, one.exposed);
    one.motion = std::move(motion);
    return one.exposed;
  }

  lab::Room room;
  lab::Robot robot;
  std::vector<std::unique_ptr<Eye>> eyes;
};

StereoLab::StereoLab(StereoLabOptions options)
    : options_(checkedStereo(std::move(options))), parts_(std::make_unique<Parts>(options_)) {}
StereoLab::~StereoLab() = default;

std::optional<std::uint64_t> StereoLab::count() const {
  if (options_.room.frames == 0) return std::nullopt;
  return options_.room.frames;
}

std::optional<TagLayout> StereoLab::tags() const {
  return layoutOf(options_.room.tags);
}

nanoseconds StereoLab::time(std::size_t eye, std::uint64_t k) const {
  const long double since = static_cast<long double>(k) * 1e9L / options_.room.fps;
  return options_.room.start + nanoseconds(std::llround(since)) +
         (eye == 1 ? options_.right_late : nanoseconds(0));
}

Isometry3d StereoLab::T_world_head(nanoseconds time) const {
  return options_.head(time);
}

Vector3d StereoLab::robotPoseMap(nanoseconds time) const {
  const LabOptions& room = options_.room;
  if (!room.robot_pose_map) return Vector3d::Zero();
  const auto rest = static_cast<double>(room.rest_frames) - 0.5;
  const bool rests = time < room.start + nanoseconds(std::llround(1e9 * rest / room.fps));
  return room.robot_pose_map(rests ? room.start : time);
}

std::optional<Vector2d> StereoLab::truePixel(std::size_t eye, std::uint64_t k,
                                             const Vector3d& p_world) const {
  const RigCamera& camera = options_.rig.cameras.at(eye);
  double row = camera.info.height / 2.0 - 0.5;
  Vector2d px = Vector2d::Zero();
  for (int i = 0; i < (camera.readout.count() > 0 ? 10 : 1); ++i) {
    const Isometry3d T_world_camera =
        T_world_head(rowTime(camera, time(eye, k), row)) * options_.rig.T_head_camera(eye);
    const Vector3d p = T_world_camera.inverse() * p_world;
    if (p.z() < 0.05) return std::nullopt;
    px = lab::projectByOpenCv(camera.info, {p}).front();
    row = std::clamp(px.y(), -0.5, camera.info.height - 0.5);
  }
  return px;
}

Frame StereoLab::frame(std::size_t eye, std::uint64_t k) const {
  const RigCamera& camera = options_.rig.cameras.at(eye);
  const nanoseconds mid = time(eye, k), window = options_.room.exposure + camera.readout;
  const std::chrono::duration<double> exposure = options_.room.exposure, readout = camera.readout;
  lab::WalkMotion motion;
  motion.robot.exposure = exposure.count();
  motion.robot.readout = readout.count();
  const int poses = window.count() == 0 ? 1 : kWalkPoses;
  for (int i = 0; i < poses; ++i) {
    const nanoseconds at = poses == 1 ? mid : mid - window / 2 + window * i / (poses - 1);
    const Vector3d robot = robotPoseMap(at);
    motion.robot.T_world_robot.push_back(options_.room.T_world_map *
                                         (Eigen::Translation3d(robot.x(), robot.y(), 0) *
                                          Eigen::AngleAxisd(robot.z(), Vector3d::UnitZ())));
    motion.T_world_camera.push_back(T_world_head(at) * options_.rig.T_head_camera(eye));
  }
  if (options_.bystander) motion.bystander = options_.bystander(mid);
  const lab::Canvas& exposed = parts_->expose(eye, std::move(motion), options_.light);
  return {.time = mid - camera.time_offset,
          .sequence = k,
          .source = eye == 0 ? "lab left" : "lab right",
          .width = camera.info.width,
          .height = camera.info.height,
          .bgr = parts_->eyes[eye]->sensor.read(exposed, k)};
}

StereoFrame StereoLab::pair(std::uint64_t k) const {
  StereoFrame both;
  for (std::size_t eye = 0; eye < options_.rig.cameras.size(); ++eye)
    both.eyes[eye] = frame(eye, k);
  return both;
}

std::optional<StereoFrame> StereoLab::next() {
  if (options_.room.frames != 0 && next_ >= options_.room.frames) return std::nullopt;
  return pair(next_++);
}

}  // namespace slamscope::tracking
