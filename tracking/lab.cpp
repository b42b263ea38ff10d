// SPDX-License-Identifier: MIT
#include "tracking/lab.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "tracking/lab_painter.hpp"
#include "tracking/lab_sensor.hpp"

namespace slamscope::tracking {
namespace {

constexpr int kPoses = 65;  // of the robot during one exposure: under 0.02 px from one to the next

void check(const LabOptions& options) {
  const auto require = [](bool met, const char* what) {
    if (!met) throw std::invalid_argument(std::string("lab: ") + what);
  };
  require(options.fps > 0, "frames a second must be more than 0");
  require(options.exposure.count() >= 0 && options.readout.count() >= 0,
          "exposure and readout can't be negative");
  require(options.defocus_px >= 0 && options.defocus_px <= 20, "defocus must be 0 to 20 px");
  require(options.noise >= 0, "noise can't be negative");
  require(options.vignette >= 0 && options.vignette <= 1, "vignette must be 0 to 1");
}

LabOptions checked(LabOptions options) {
  check(options);
  return options;
}

void copy(const lab::Canvas& from, const lab::Region& region, lab::Canvas& to) {
  for (int row = region.top; row < region.bottom; ++row)
    std::copy_n(&from.at(region.left, row), region.right - region.left, &to.at(region.left, row));
}

Eigen::Isometry3d inPlane(const Eigen::Vector3d& pose) {
  return Eigen::Translation3d(pose.x(), pose.y(), 0) *
         Eigen::AngleAxisd(pose.z(), Eigen::Vector3d::UnitZ());
}

}  // namespace

struct Lab::Parts {
  explicit Parts(const LabOptions& options)
      : room(options), robot(options), painter(options, room, robot), sensor(options) {
    const lab::Canvas& light = painter.background();
    still = painted = light;
    sensor.expose(light, {0, 0, light.width, light.height}, still);
    exposed = still;
  }

  /// Brings `exposed` up to date: only where the robot is, or was.
  void expose(lab::Motion now) {
    const bool rests = now.T_world_robot.size() == 1 && motion.T_world_robot.size() == 1;
    if (rests && now.T_world_robot.front().matrix() == motion.T_world_robot.front().matrix())
      return;
    const lab::Canvas& light = painter.background();
    copy(light, changed, painted);
    copy(still, changed.grown(sensor.margin(), light.width, light.height), exposed);
    motion = std::move(now);
    changed = painter.changed(motion);
    painter.paintRobot(painted, changed, motion);
    sensor.expose(painted, changed.grown(sensor.margin(), light.width, light.height), exposed);
  }

  lab::Room room;
  lab::Robot robot;
  lab::Painter painter;
  lab::Sensor sensor;
  lab::Canvas still;  // the empty room, as the sensor sees it
  // The frame asked for last, before the lens and after it (a robot that rests is painted once).
  lab::Canvas painted, exposed;
  lab::Motion motion;
  lab::Region changed;
};

Lab::Lab(LabOptions options)
    : options_(checked(std::move(options))), parts_(std::make_unique<Parts>(options_)) {}

Lab::~Lab() = default;

std::optional<std::uint64_t> Lab::count() const {
  if (options_.frames == 0) return std::nullopt;
  return options_.frames;
}

std::chrono::nanoseconds Lab::time(std::uint64_t k) const {
  const long double since = static_cast<long double>(k) * 1e9L / options_.fps;
  return options_.start + std::chrono::nanoseconds(std::llround(since));
}

Eigen::Vector3d Lab::robotPoseMap(std::uint64_t k) const {
  if (!options_.robot_pose_map) return Eigen::Vector3d::Zero();
  return options_.robot_pose_map(k < options_.rest_frames ? options_.start : time(k));
}

lab::Motion Lab::motion(std::uint64_t k) const {
  const auto pose = [&](const Eigen::Vector3d& pose_map) -> Eigen::Isometry3d {
    return options_.T_world_map * inPlane(pose_map);
  };
  lab::Motion motion{.T_world_robot = {pose(robotPoseMap(k))}};
  const std::chrono::nanoseconds window = options_.exposure + options_.readout;
  if (!options_.robot_pose_map || k < options_.rest_frames || window.count() == 0) return motion;
  const auto pose_at = [&](int i) {
    return options_.robot_pose_map(time(k) - window / 2 + window * i / (kPoses - 1));
  };
  const Eigen::Vector3d first = pose_at(0);
  bool rests = true;
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < kPoses; ++i) {
    const Eigen::Vector3d here = pose_at(i);
    rests = rests && here == first;
    poses.push_back(pose(here));
  }
  if (rests) return motion;
  const std::chrono::duration<double> exposure = options_.exposure, readout = options_.readout;
  return {
      .T_world_robot = std::move(poses), .exposure = exposure.count(), .readout = readout.count()};
}

Frame Lab::frame(std::uint64_t k) const {
  parts_->expose(motion(k));
  return {.time = time(k),
          .sequence = k,
          .source = "lab",
          .width = options_.camera.width,
          .height = options_.camera.height,
          .bgr = parts_->sensor.read(parts_->exposed, k)};
}

std::optional<Frame> Lab::next() {
  if (options_.frames != 0 && next_ >= options_.frames) return std::nullopt;
  return frame(next_++);
}

}  // namespace slamscope::tracking
