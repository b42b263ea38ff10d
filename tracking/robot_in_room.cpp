// SPDX-License-Identifier: MIT
#include "tracking/robot_in_room.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tracking/registration_average.hpp"
#include "tracking/registration_error.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Matrix3d, Eigen::Vector3d;

constexpr int kFewPictures = 6;     // that make a start, when the robot sets off early
constexpr double kScaleOff = 0.04;  // of the tag; beyond it what was stated is wrong
constexpr double kCornerBias_px = 0.02;

/// Corners of the tag as they would be at mid-exposure: the head moves while rows are exposed.
TagDetection atMidExposure(const EyeCamera& eye, const HeadMotion& motion, TagDetection tag,
                           const Isometry3d& T_world_tag, double size_m) {
  if (eye.readout == 0) return tag;
  const auto p_tag = tagCorners(size_m);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d p = T_world_tag * p_tag[i];
    const auto now = projectAt(eye, motion, p, 0);
    const auto then = projectAt(eye, motion, p, eye.rowDelay(tag.corners_px[i].y()));
    if (now && then) tag.corners_px[i] += *now - *then;
  }
  return tag;
}

}  // namespace

struct RobotInRoom::Parts {
  RobotTag robot;
  int wanted;
  std::vector<EyeCamera> eyes;
  MapAverage average;
  std::optional<MapPlace> stored;
  double residual_px = 0;
  std::vector<std::string> problems;

  /// The map by one picture, with the covariance of corners and head.
  std::optional<MapPlace> oneWord(const EyeCamera& eye, const HeadMotion& motion,
                                  const TagDetection& seen) {
    const Isometry3d T_camera_world = (motion.T_world_head * eye.T_head_camera).inverse();
    auto start = planarStart(eye.model, T_camera_world, robot, seen);
    if (!start) return std::nullopt;
    const TagDetection mid =
        atMidExposure(eye, motion, seen, start->T_world_map * robot.T_robot_tag, robot.size_m);
    start = planarStart(eye.model, T_camera_world, robot, mid);
    if (!start) return std::nullopt;
    if (std::abs(start->scale - 1) > kScaleOff) return nameScale(start->scale);
    SceneProblem problem;
    problem.solve_camera = false;
    problem.solve_map = true;
    problem.robust = false;
    const auto p_tag = tagCorners(robot.size_m);
    for (std::size_t i = 0; i < 4; ++i) {
      problem.corners.push_back({robot.T_robot_tag * p_tag[i], true, mid.corners_px[i],
                                 std::hypot(mid.sigma_px[i], kCornerBias_px), robot.id});
    }
    const auto fit = fitScene(eye.model, problem, {T_camera_world, start->T_world_map});
    if (!fit) return std::nullopt;
    residual_px = fit->residual_px;
    MapPlace place{fit->pose.T_world_map, fit->covariance.bottomRightCorner<3, 3>()};
    place.covariance += byHead(place.T_world_map, motion);
    return place;
  }

  std::optional<MapPlace> nameScale(double scale) {
    std::array<char, 128> text{};
    std::snprintf(
        text.data(), text.size(),
        "robot's tag %d looks %.3f m wide where %.3f m is stated (or its height is another)",
        robot.id, scale * robot.size_m, robot.size_m);
    problems.assign(1, text.data());
    return std::nullopt;
  }

  /// A head that is off by (ρ, φ) carries the tag along; what of that lies in the floor.
  [[nodiscard]] Matrix3d byHead(const Isometry3d& T_world_map, const HeadMotion& motion) const {
    const Vector3d p_tag = T_world_map * robot.T_robot_tag.translation();
    const Matrix3d R = motion.T_world_head.linear();
    const Vector3d p_head = motion.T_world_head.inverse() * p_tag;
    const Matrix3d R_map_world = T_world_map.linear().transpose();
    const Matrix3d R_map_head = R_map_world * R;
    Eigen::Matrix<double, 3, 6> carried;  // of the tag, map axes
    carried << R_map_head, -R_map_head * skew(p_head);
    // The tag's height is known: what is carried up slides along the ray, back to its plane.
    const Vector3d ray = R_map_world * (p_tag - motion.T_world_head.translation());
    Eigen::Matrix<double, 3, 6> J;
    J.topRows<2>() = carried.topRows<2>() - ray.head<2>() / ray.z() * carried.row(2);
    J.row(2) << 0, 0, 0, R_map_head.row(2);
    return J * motion.covariance.topLeftCorner<6, 6>() * J.transpose();
  }
};

RobotInRoom::RobotInRoom(const Rig& rig, RobotTag robot, int pictures)
    : parts_(std::make_unique<Parts>()) {
  parts_->robot = std::move(robot);
  parts_->wanted = std::max(1, pictures);
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) parts_->eyes.emplace_back(rig, i);
}
RobotInRoom::~RobotInRoom() = default;
RobotInRoom::RobotInRoom(RobotInRoom&&) noexcept = default;
RobotInRoom& RobotInRoom::operator=(RobotInRoom&&) noexcept = default;

void RobotInRoom::add(const HeadPose& head, const HeadPicture& picture) {
  Parts& parts = *parts_;
  if (parts.stored || head.state != HeadState::tracking) return;
  parts.problems.clear();
  const TagDetection* seen = nullptr;
  for (const TagDetection& tag : picture.tags) {
    if (tag.id != parts.robot.id) continue;
    if (seen) {
      parts.problems.push_back("robot's tag " + std::to_string(tag.id) + " is seen more than once");
      return;
    }
    seen = &tag;
  }
  if (!seen) return;
  const auto place = parts.oneWord(parts.eyes.at(picture.camera), head.motion, *seen);
  if (!place) return;
  const bool set_off = !parts.average.add(place->T_world_map, place->covariance);
  if (set_off && parts.average.frames() < kFewPictures) return parts.average.clear();
  if (set_off || parts.average.frames() >= parts.wanted) parts.stored = soFar();
}

std::optional<MapPlace> RobotInRoom::soFar() const {
  if (parts_->average.frames() == 0) return std::nullopt;
  return MapPlace{parts_->average.pose(), parts_->average.covariance()};
}

const std::optional<MapPlace>& RobotInRoom::place() const {
  return parts_->stored;
}

int RobotInRoom::pictures() const {
  return parts_->average.frames();
}

double RobotInRoom::residual_px() const {
  return parts_->residual_px;
}

const std::vector<std::string>& RobotInRoom::problems() const {
  return parts_->problems;
}

std::string RobotInRoom::status() const {
  const int count = pictures();
  if (!parts_->stored) {
    if (count == 0) return "robot's tag " + std::to_string(parts_->robot.id) + " not seen yet";
    return "registering the robot: picture " + std::to_string(count) + " of " +
           std::to_string(parts_->wanted);
  }
  const Matrix3d& S = parts_->stored->covariance;
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), "robot registered: %d pictures, ±%.1f mm ±%.2f°", count,
                1e3 * std::sqrt((S(0, 0) + S(1, 1)) / 2),
                180 / std::numbers::pi * std::sqrt(S(2, 2)));
  return text.data();
}

}  // namespace slamscope::tracking
