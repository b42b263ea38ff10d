// SPDX-License-Identifier: MIT
#include "tracking/registration.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "tracking/registration_average.hpp"
#include "tracking/registration_error.hpp"

namespace slamscope::tracking {
namespace {

constexpr std::size_t kLeastFrames = 3;  // that make a start, when the robot sets off early
constexpr double kMoved_px = 1.0;        // shift of the robot's tag that is a move
constexpr double kPriorSeconds = 1.0;    // as long the pose before tells which of two is meant
constexpr double kLargeResidual_px = 1;  // beyond it something is wrong with what was stated

std::string bare(const std::string& family) {
  return family.starts_with("tag") ? family.substr(3) : family;
}

Eigen::Vector2d centre(const TagDetection& tag) {
  return (tag.corners_px[0] + tag.corners_px[1] + tag.corners_px[2] + tag.corners_px[3]) / 4;
}

void check(const RegistrationOptions& options) {
  const auto& robot = options.robot;
  const TagLayout& layout = options.layout;
  if (options.frames < 1) throw std::invalid_argument("registration: frames must be at least 1");
  if (!robot && layout.tags.empty() && !options.camera_pose) {
    throw std::invalid_argument(
        "registration: expected the robot's tag, a camera pose or tags of known place");
  }
  if (!robot || layout.tags.empty()) return;
  if (bare(robot->family) != bare(layout.family)) {
    throw std::invalid_argument("registration: the robot's tag is of " + robot->family +
                                ", the layout's of " + layout.family);
  }
  if (layout.find(robot->id)) {
    throw std::invalid_argument("registration: tag " + std::to_string(robot->id) +
                                " is the robot's and one of the layout");
  }
}

}  // namespace

const char* name(RegistrationState state) {
  switch (state) {
    case RegistrationState::searching:
      return "searching";
    case RegistrationState::registering:
      return "registering";
    case RegistrationState::registered:
      return "registered";
    case RegistrationState::ambiguous:
      return "ambiguous";
    case RegistrationState::lost:
      return "lost";
  }
  return "";
}

const char* name(RegistrationMode mode) {
  switch (mode) {
    case RegistrationMode::plane:
      return "plane";
    case RegistrationMode::layout:
      return "layout";
    case RegistrationMode::free_tag:
      return "free-tag";
  }
  return "";
}

struct Registration::Parts {
  RegistrationSetup setup;
  std::string missing;  // what state searching or lost waits for
  // A camera that stands.
  std::vector<RegistrationView> views;
  bool floor_seen = false;
  // A camera that moves.
  bool moving_camera = false, map_known = false;
  MapAverage map;
  std::optional<Eigen::Isometry3d> last_T_camera_world;
  std::chrono::nanoseconds last_time{};

  /// Sorts a frame's tags; names a robot's tag that is seen twice.
  RegistrationView select(std::span<const TagDetection> detections,
                          std::vector<std::string>& problems) const {
    RegistrationView view;
    bool doubled = false;
    for (const TagDetection& tag : detections) {
      if (setup.layout.find(tag.id)) view.floor.push_back(tag);
      if (!setup.robot || tag.id != setup.robot->id) continue;
      doubled = doubled || view.robot.has_value();
      view.robot = tag;
    }
    if (doubled) {
      problems.push_back("robot's tag " + std::to_string(setup.robot->id) +
                         " is seen more than once");
      view.robot.reset();
    }
    return view;
  }

  /// What of the tags needed isn't there, or nothing.
  [[nodiscard]] std::string lacks(const RegistrationView& view, RegistrationMode mode) const {
    const auto robots = [](int id, const std::string& family) {
      return "no robot's tag " + std::to_string(id) + " (" + family + ") in view";
    };
    const bool camera_known = !moving_camera && (setup.camera_pose.has_value() || floor_seen ||
                                                 setup.layout.tags.empty());
    if (view.floor.empty() && !camera_known) {
      return mode == RegistrationMode::free_tag
                 ? robots(setup.layout.tags[0].id, setup.layout.family)
                 : "no tag of the layout (" + setup.layout.family + ") in view";
    }
    if (setup.robot && !map_known && !view.robot) {
      return robots(setup.robot->id, setup.robot->family);
    }
    return {};
  }

  /// The robot isn't where it was in the frames gathered.
  [[nodiscard]] bool movedAway(const TagDetection& robot) const {
    std::vector<TagDetection> before;
    for (const RegistrationView& view : views) before.push_back(*view.robot);
    return !before.empty() && (centre(robot) - centre(typicalDetection(before))).norm() > kMoved_px;
  }

  /// Takes the frame's word on the map's place; true once that is known.
  bool learnMap(const CameraModel& camera, const RegistrationView& view, const TagPose& pose,
                int frames) {
    // What is biased in one frame is in all of them: see corner_bias_px.
    RegistrationSetup one_of_many = setup;
    one_of_many.corner_bias_px *= std::sqrt(frames);
    const auto fit = pose.ambiguous ? std::nullopt : fitMapInView(camera, one_of_many, view, pose);
    if (fit && !map.add(fit->pose.T_world_map, fit->covariance.bottomRightCorner<3, 3>())) {
      // It sets off: the start lies in the frames before.
      map_known = map.frames() >= static_cast<int>(kLeastFrames);
      if (!map_known) map.clear();
    }
    map_known = map_known || map.frames() >= frames;
    return map_known;
  }
};

Registration::Registration(RegistrationOptions options, CameraModel camera)
    : options_(std::move(options)), camera_(std::move(camera)), parts_(std::make_unique<Parts>()) {
  check(options_);
  RegistrationSetup& setup = parts_->setup;
  setup = {options_.layout, options_.robot, options_.camera_pose, options_.corner_bias_px};
  if (!setup.robot) {
    mode_ = RegistrationMode::layout;
  } else if (setup.layout.tags.empty() && !setup.camera_pose) {
    // Nothing says where the floor is: the robot's tag is all the layout there is, and map = world.
    mode_ = RegistrationMode::free_tag;
    const RobotTag robot = *setup.robot;
    setup.layout = {robot.family, {{robot.id, robot.size_m, robot.T_robot_tag}}};
    setup.robot.reset();
  }
  parts_->moving_camera = options_.continuous && !setup.layout.tags.empty();
  if (!setup.robot && setup.layout.tags.empty()) finish();  // the camera's pose is all there is
}

Registration::~Registration() = default;
Registration::Registration(Registration&&) noexcept = default;
Registration& Registration::operator=(Registration&&) noexcept = default;

void Registration::add(std::chrono::nanoseconds time, std::span<const TagDetection> detections) {
  if (parts_->moving_camera) return follow(time, detections);
  if (state_ != RegistrationState::registered) gather(detections);
}

void Registration::gather(std::span<const TagDetection> detections) {
  problems_.clear();
  RegistrationView view = parts_->select(detections, problems_);
  parts_->floor_seen = parts_->floor_seen || !view.floor.empty();
  parts_->missing = parts_->lacks(view, mode_);
  if (!parts_->missing.empty()) return;
  auto& views = parts_->views;
  if (view.robot && parts_->movedAway(*view.robot)) {
    // It sets off: the start lies in the frames before.
    if (views.size() >= kLeastFrames) return finish();
    views.clear();
  }
  views.push_back(std::move(view));
  if (state_ != RegistrationState::ambiguous) state_ = RegistrationState::registering;
  if (static_cast<int>(views.size()) >= options_.frames) finish();
}

void Registration::settle() {
  if (state_ != RegistrationState::registered && !parts_->views.empty()) finish();
}

void Registration::finish() {
  const AveragedRegistration average = averageViews(camera_, parts_->setup, parts_->views);
  RegistrationResult result;
  result.frames = static_cast<int>(parts_->views.size());
  parts_->views.clear();
  problems_ = average.problems;
  if (!average.found) {
    parts_->missing = problems_.back();
    state_ = RegistrationState::searching;
    return;
  }
  result.tags = average.tags;
  result.residual_px = average.residual_px;
  result.T_camera_world = average.pose.T_camera_world;
  result.T_world_map = average.pose.T_world_map;
  const auto M = mapPerturbation(result.T_world_map);
  result.covariance = M * average.covariance * M.transpose();
  publish(std::move(result), average.ambiguous);
}

void Registration::follow(std::chrono::nanoseconds time, std::span<const TagDetection> detections) {
  problems_.clear();
  result_.reset();
  RegistrationView view = parts_->select(detections, problems_);
  parts_->missing = parts_->lacks({view.floor, TagDetection{}}, mode_);
  auto& last = parts_->last_T_camera_world;
  TagPoseOptions pose_options;
  const std::chrono::duration<double> age = time - parts_->last_time;
  if (last && std::abs(age.count()) < kPriorSeconds) pose_options.prior_T_camera_world = last;
  if (!last && options_.camera_pose) {
    pose_options.prior_T_camera_world = options_.camera_pose->T_camera_world;
  }
  std::vector<TagDetection> floor = view.floor;
  for (TagDetection& tag : floor) {
    for (double& sigma : tag.sigma_px) sigma = std::hypot(sigma, options_.corner_bias_px);
  }
  const auto camera = estimateTagPose(camera_, parts_->setup.layout, floor, pose_options);
  if (!camera) {
    state_ = last ? RegistrationState::lost : RegistrationState::searching;
    if (parts_->missing.empty()) parts_->missing = "no camera pose fits the tags of the layout";
    return;
  }
  for (const int id : camera->rejected_ids) problems_.push_back(misfit(id));
  if (!camera->ambiguous) {
    last = camera->T_camera_world;
    parts_->last_time = time;
  }
  RegistrationResult result;
  Matrix9d S = Matrix9d::Zero();
  S.topLeftCorner<6, 6>() = camera->covariance;
  if (parts_->setup.robot) {
    parts_->missing = parts_->lacks(view, mode_);
    if (!parts_->map_known && !parts_->learnMap(camera_, view, *camera, options_.frames)) {
      state_ =
          parts_->map.frames() > 0 ? RegistrationState::registering : RegistrationState::searching;
      return;
    }
    result.T_world_map = parts_->map.pose();
    S.bottomRightCorner<3, 3>() = parts_->map.covariance();
  }
  result.frames = 1;
  result.tags = camera->tags;
  result.residual_px = camera->residual_px;
  result.T_camera_world = camera->T_camera_world;
  const auto M = mapPerturbation(result.T_world_map);
  result.covariance = M * S * M.transpose();
  publish(std::move(result), camera->ambiguous);
}

void Registration::publish(RegistrationResult result, bool ambiguous) {
  result.mode = mode_;
  result.T_camera_map = result.T_camera_world * result.T_world_map;
  const PredictedError error = predictError(camera_, result, options_.extent_m);
  result.overlay_error_px = error.overlay_px;
  result.floor_error_mm = 1e3 * error.floor_m;
  if (result.residual_px > kLargeResidual_px) {
    std::array<char, 128> text{};
    std::snprintf(
        text.data(), text.size(),
        "residual %.1f px: camera info, tag sizes or the tags' places do not fit the picture",
        result.residual_px);
    problems_.emplace_back(text.data());
  }
  state_ = ambiguous ? RegistrationState::ambiguous : RegistrationState::registered;
  result_ = std::move(result);
}

std::string Registration::status() const {
  std::string text = name(state_);
  if (state_ == RegistrationState::searching || state_ == RegistrationState::lost) {
    return text + ": " + (parts_->missing.empty() ? "waiting for frames" : parts_->missing);
  }
  if (state_ == RegistrationState::registering) {
    const std::size_t done = parts_->moving_camera ? static_cast<std::size_t>(parts_->map.frames())
                                                   : parts_->views.size();
    return text + ": frame " + std::to_string(done) + " of " + std::to_string(options_.frames) +
           (parts_->missing.empty() ? "" : ", " + parts_->missing);
  }
  std::array<char, 160> numbers{};
  std::snprintf(numbers.data(), numbers.size(),
                " (%s): %d frame%s, %d tag%s, residual %.2f px, overlay ±%.2f px, floor ±%.1f mm",
                name(mode_), result_->frames, result_->frames == 1 ? "" : "s", result_->tags,
                result_->tags == 1 ? "" : "s", result_->residual_px, result_->overlay_error_px,
                result_->floor_error_mm);
  return text + numbers.data();
}

}  // namespace slamscope::tracking
