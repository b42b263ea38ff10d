// SPDX-License-Identifier: MIT
#include "apps/lib/view/camera_setup.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <stdexcept>

#include "apps/lib/view/legend.hpp"
#include "slam/world.hpp"

namespace slamscope::apps {
namespace {

using std::chrono::nanoseconds;

/// Half the side of the square of floor that the default overhead camera sees whole (m).
constexpr double kLabHalfSide = 1.46;
/// A turn of the map in the room, so that nothing in the picture is axis-aligned by accident.
constexpr double kLabMapTurn = 0.12;  // rad

/// All that truly happens, in the frame of the map.
Eigen::AlignedBox2d extentOf(const RunTruth& truth) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& feature : truth.features) box.extend(feature);
  constexpr int kSamples = 400;
  for (int k = 0; k <= kSamples; ++k) {
    const nanoseconds time = truth.start + (truth.end - truth.start) / kSamples * k;
    box.extend(Eigen::Vector2d(truth.pose(time).head<2>()));
  }
  return box;
}

/// Half the side of the square about `centre` that holds the box.
double reachFrom(const Eigen::Vector2d& centre, const Eigen::AlignedBox2d& box) {
  return std::max((box.max() - centre).maxCoeff(), (centre - box.min()).maxCoeff());
}

/// Puts the scene of the run into the room: the paper's experiment at full size with its loop in
/// the middle, anything larger scaled to fit.
LabPlacement placeMap(tracking::LabOptions& lab, const MonitorOptions& options,
                      const RunTruth& truth) {
  const Eigen::AlignedBox2d box = extentOf(truth);
  Eigen::Vector2d centre = slam::kLoopCentre;
  LabPlacement placed{.map_scale = options.map_scale.value_or(1.0), .notes = {}};
  if (placed.map_scale * reachFrom(centre, box) > kLabHalfSide) centre = box.center();
  const double reach = reachFrom(centre, box);
  if (!options.map_scale && reach > kLabHalfSide) {
    placed.map_scale = 1.0 / (std::ceil(10.0 * reach / kLabHalfSide) / 10.0);
    char note[120];
    std::snprintf(
        note, sizeof note,
        "the run reaches over %.3g m: the lab shows it at 1:%.3g (--map-scale says otherwise)",
        2.0 * reach, 1.0 / placed.map_scale);
    placed.notes.emplace_back(note);
  }
  const Eigen::Rotation2Dd turn(kLabMapTurn);
  const Eigen::Vector2d origin = -(placed.map_scale * (turn * centre));
  lab.T_world_map = Eigen::Translation3d(origin.x(), origin.y(), 0.0) *
                    Eigen::AngleAxisd(kLabMapTurn, Eigen::Vector3d::UnitZ());
  return placed;
}

CameraSetup openLab(const MonitorOptions& options, const std::optional<RunTruth>& truth) {
  CameraSetup setup;
  setup.lab = tracking::defaultLab();
  tracking::LabOptions& lab = *setup.lab;
  if (!options.camera_info.empty()) lab.camera = tracking::readCameraInfo(options.camera_info);
  if (options.fps > 0.0) lab.fps = options.fps;
  lab.frames = options.frames;
  lab.seed = options.lab_seed;
  LabPlacement placed = placeInLab(lab, options, truth);
  setup.map_scale = placed.map_scale;
  setup.notes = std::move(placed.notes);
  setup.info = lab.camera;
  setup.fps = lab.fps;
  setup.source = std::make_unique<tracking::Lab>(lab);

  tracking::TagLayout& layout = setup.registration.layout;
  for (const tracking::LabTag& tag : lab.tags) {
    layout.tags.push_back({tag.id, tag.size, tag.T_world_tag});
  }
  setup.registration.robot = tracking::RobotTag{
      .id = lab.robot_tag_id, .size_m = lab.robot_tag_size, .T_robot_tag = lab.T_robot_tag};
  return setup;
}

/// A field of view of about 65°, as most webcams have; square pixels, centre in the middle.
tracking::CameraInfo guessedInfo(int width, int height) {
  tracking::CameraInfo info;
  info.width = width;
  info.height = height;
  info.K << 0.8 * width, 0.0, 0.5 * (width - 1), 0.0, 0.8 * width, 0.5 * (height - 1), 0.0, 0.0,
      1.0;
  return info;
}

/// Hands its first two frames out again: their size and their distance in time had to be known
/// before anything else.
class PeekedSource : public tracking::FrameSource {
 public:
  explicit PeekedSource(std::unique_ptr<tracking::FrameSource> source)
      : source_(std::move(source)) {
    while (ahead_.size() < 2) {
      auto frame = source_->next();
      if (!frame) break;
      ahead_.push_back(std::move(*frame));
    }
  }
  [[nodiscard]] const tracking::Frame* first() const {
    return ahead_.empty() ? nullptr : &ahead_.front();
  }
  /// 0 where there is only one frame.
  [[nodiscard]] double framesPerSecond() const {
    if (ahead_.size() < 2) return 0.0;
    return 1.0 / std::chrono::duration<double>(ahead_[1].time - ahead_[0].time).count();
  }
  std::optional<tracking::Frame> next() override {
    if (ahead_.empty()) return source_->next();
    std::optional<tracking::Frame> frame(std::move(ahead_.front()));
    ahead_.pop_front();
    return frame;
  }
  [[nodiscard]] bool live() const override { return source_->live(); }
  [[nodiscard]] bool stamped() const override { return source_->stamped(); }
  [[nodiscard]] std::optional<std::uint64_t> count() const override { return source_->count(); }

 private:
  std::unique_ptr<tracking::FrameSource> source_;
  std::deque<tracking::Frame> ahead_;
};

CameraSetup openRealCamera(const MonitorOptions& options) {
  CameraSetup setup;
  auto source = std::make_unique<PeekedSource>(
      tracking::openFrameSource(options.camera, {.fps = options.fps, .v4l2 = options.v4l2}));
  const tracking::Frame* first = source->first();
  if (first == nullptr) throw std::runtime_error(options.camera + ": no frame in it");
  if (options.camera_info.empty()) {
    setup.info = guessedInfo(first->width, first->height);
    setup.calibrated = false;
    setup.notes.emplace_back(
        "no --camera-info: intrinsics are guessed, the picture is uncalibrated");
  } else {
    setup.info = tracking::readCameraInfo(options.camera_info);
    if (setup.info.width != first->width || setup.info.height != first->height) {
      throw std::runtime_error(options.camera_info.string() + ": it is for pictures of " +
                               std::to_string(setup.info.width) + " x " +
                               std::to_string(setup.info.height) + ", the camera's are " +
                               std::to_string(first->width) + " x " +
                               std::to_string(first->height));
    }
  }
  if (source->framesPerSecond() > 0.0) setup.fps = source->framesPerSecond();
  setup.source = std::move(source);
  setup.map_scale = options.map_scale.value_or(1.0);
  return setup;
}

void chooseRobot(CameraSetup& setup, const MonitorOptions& options) {
  tracking::RegistrationOptions& registration = setup.registration;
  const bool room_known = !registration.layout.tags.empty() || registration.camera_pose;
  if (options.robot == "none") {
    if (!room_known) {
      throw std::runtime_error(
          "--robot none needs --tags or --camera-pose to say where the map is");
    }
    registration.robot.reset();
  } else if (!options.robot.empty()) {
    registration.robot = tracking::readRobotTag(options.robot);
  } else if (!setup.lab && registration.continuous && !registration.layout.tags.empty()) {
    registration.robot.reset();
    setup.notes.emplace_back(
        "no --robot: the map starts at the origin of the tags' world, x ahead");
  }
}

}  // namespace

LabPlacement placeInLab(tracking::LabOptions& lab, const MonitorOptions& options,
                        const std::optional<RunTruth>& truth) {
  if (!truth) {
    lab.T_world_map = Eigen::AngleAxisd(kLabMapTurn, Eigen::Vector3d::UnitZ());
    return {.map_scale = options.map_scale.value_or(1.0),
            .notes = {"the run carries no truth: the lab shows the floor and the robot's tag at "
                      "the map's origin"}};
  }
  LabPlacement placed = placeMap(lab, options, *truth);
  const double scale = placed.map_scale;
  for (std::size_t k = 0; k < truth->ids.size(); ++k) {
    lab.posts.push_back({truth->ids[k], scale * truth->features[k]});
  }
  // What a laser sees stands there too; the room's own things, which it was not told of, do not.
  for (const slam::LaserWall& wall : truth->walls) {
    lab.boards.push_back({scale * wall.from, scale * wall.to, wall.glossy});
  }
  if (!truth->walls.empty()) lab.furniture = false;
  if (truth->post_radius > 0.0) lab.post_radius = scale * truth->post_radius;
  lab.start = truth->start;
  lab.robot_pose_map = [truth = *truth, scale, rate = options.slam_rate](nanoseconds time) {
    const double since = rate * static_cast<double>((time - truth.start).count());
    Eigen::Vector3d pose = truth.pose(truth.start + nanoseconds(std::llround(since)));
    pose.head<2>() *= scale;
    return pose;
  };
  return placed;
}

CameraSetup openCamera(const MonitorOptions& options, const std::optional<RunTruth>& truth) {
  CameraSetup setup = options.camera == "lab" ? openLab(options, truth) : openRealCamera(options);
  tracking::RegistrationOptions& registration = setup.registration;
  registration.continuous = options.continuous;
  if (!options.tags.empty()) registration.layout = tracking::readTagLayout(options.tags);
  if (!options.camera_pose.empty()) {
    registration.camera_pose = tracking::readCameraPose(options.camera_pose);
  }
  chooseRobot(setup, options);

  // A short film can't spend thirty frames on standing still.
  std::uint64_t count = setup.source->count().value_or(0);
  if (options.frames > 0) count = count > 0 ? std::min(count, options.frames) : options.frames;
  if (count > 0) {
    registration.frames = static_cast<int>(std::clamp<std::uint64_t>(
        (count + 1) / 2, 1, static_cast<std::uint64_t>(registration.frames)));
  }
  return setup;
}

}  // namespace slamscope::apps
