// SPDX-License-Identifier: MIT
#include "tracking/registration_average.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "tracking/median.hpp"
#include "tracking/registration_error.hpp"
#include "tracking/symmetric_solve.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Vector3d;

constexpr double kWrongScale = 0.04;  // of the robot's tag; beyond it what was stated is wrong
constexpr double kMoved_m = 0.02, kMoved_rad = 0.05;

using Sightings = std::map<int, std::vector<TagDetection>>;

/// Corners of all sightings of one tag. A bias that is the same in each of n frames counts n times
/// as much as noise does, so that n such corners together know no more than the bias lets them.
void append(std::vector<CornerSight>& corners, const std::vector<TagDetection>& seen,
            const MappedTag& tag, bool on_map, double bias_px) {
  const auto p_tag = tagCorners(tag.size_m);
  const double n = static_cast<double>(seen.size());
  for (const TagDetection& detection : seen) {
    for (std::size_t i = 0; i < 4; ++i) {
      const double sigma = std::sqrt(std::pow(detection.sigma_px[i], 2) + n * bias_px * bias_px);
      corners.push_back(
          {tag.T_world_tag * p_tag[i], on_map, detection.corners_px[i], sigma, tag.id});
    }
  }
}

bool contains(const std::vector<int>& ids, int id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

/// The camera's pose as it was measured beforehand: exact, or a prior.
void applyCameraPose(const CameraPose& pose, SceneProblem& problem, ScenePose& start) {
  start.T_camera_world = pose.T_camera_world;
  if (!(pose.sigma_position_m > 0 && pose.sigma_rotation_rad > 0)) return;
  problem.solve_camera = true;
  problem.prior_T_camera_world = pose.T_camera_world;
  problem.prior_information = inverseOfSymmetric(cameraCovariance(pose));
}

/// The camera's pose by the floor's tags, whose corners join the problem. False where none fits.
bool addFloor(const CameraModel& camera, const RegistrationSetup& setup, const Sightings& floor,
              SceneProblem& problem, AveragedRegistration& result) {
  std::vector<TagDetection> typical;
  for (const auto& [id, seen] : floor) typical.push_back(typicalDetection(seen));
  TagPoseOptions options;
  if (setup.camera_pose) options.prior_T_camera_world = setup.camera_pose->T_camera_world;
  const auto pose = estimateTagPose(camera, setup.layout, typical, options);
  if (!pose) {
    result.problems.emplace_back("no camera pose fits the tags of the layout");
    return false;
  }
  result.pose.T_camera_world = pose->T_camera_world;
  result.ambiguous = pose->ambiguous;
  problem.solve_camera = true;
  for (const int id : pose->rejected_ids) result.problems.push_back(misfit(id));
  for (const auto& [id, seen] : floor) {
    if (contains(pose->rejected_ids, id)) continue;
    append(problem.corners, seen, *setup.layout.find(id), false, setup.corner_bias_px);
    ++result.tags;
  }
  return true;
}

/// The robot's tag in its plane joins the problem. False where it isn't seen there.
bool addRobot(const CameraModel& camera, const RegistrationSetup& setup,
              const std::vector<TagDetection>& seen, SceneProblem& problem,
              AveragedRegistration& result) {
  const RobotTag& robot = *setup.robot;
  const auto start = planarStart(camera, result.pose.T_camera_world, robot, typicalDetection(seen));
  if (!start) {
    result.problems.emplace_back(
        "the robot's tag is not seen on its plane: check the camera's pose");
    return false;
  }
  if (std::abs(start->scale - 1) > kWrongScale) {
    std::array<char, 128> text{};
    std::snprintf(
        text.data(), text.size(),
        "robot's tag %d looks %.3f m wide where %.3f m is stated (or its height is another)",
        robot.id, start->scale * robot.size_m, robot.size_m);
    result.problems.emplace_back(text.data());
  }
  result.pose.T_world_map = start->T_world_map;
  problem.solve_map = true;
  append(problem.corners, seen, {robot.id, robot.size_m, robot.T_robot_tag}, true,
         setup.corner_bias_px);
  ++result.tags;
  return true;
}

}  // namespace

TagDetection typicalDetection(const std::vector<TagDetection>& seen) {
  TagDetection result = seen.front();
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<double> u, v, sigma;
    for (const TagDetection& tag : seen) {
      u.push_back(tag.corners_px[i].x());
      v.push_back(tag.corners_px[i].y());
      sigma.push_back(tag.sigma_px[i]);
    }
    result.corners_px[i] = {medianOf(u), medianOf(v)};
    result.sigma_px[i] = medianOf(sigma);
  }
  return result;
}

std::string misfit(int id) {
  return "tag " + std::to_string(id) +
         " does not fit the others: moved, doubled or of another size";
}

AveragedRegistration averageViews(const CameraModel& camera, const RegistrationSetup& setup,
                                  const std::vector<RegistrationView>& views) {
  Sightings floor;
  std::vector<TagDetection> robot;
  for (const RegistrationView& view : views) {
    for (const TagDetection& tag : view.floor) floor[tag.id].push_back(tag);
    if (view.robot) robot.push_back(*view.robot);
  }
  AveragedRegistration result;
  SceneProblem problem;
  problem.solve_camera = false;
  if (setup.camera_pose) applyCameraPose(*setup.camera_pose, problem, result.pose);
  if (!floor.empty() && !addFloor(camera, setup, floor, problem, result)) return result;
  if (!robot.empty() && !addRobot(camera, setup, robot, problem, result)) return result;
  if (problem.corners.empty()) {  // all that is known is the camera's pose
    if (problem.prior_T_camera_world) {
      result.covariance.topLeftCorner<6, 6>() = cameraCovariance(*setup.camera_pose);
    }
    result.found = true;
    return result;
  }
  const auto fit = fitScene(camera, problem, result.pose);
  if (!fit) {
    result.problems.emplace_back(
        "no pose fits the tags seen: check camera info, tag sizes and layout");
    return result;
  }
  result.pose = fit->pose;
  result.covariance = fit->covariance;
  result.residual_px = fit->residual_px;
  result.found = true;
  return result;
}

std::optional<SceneFit> fitMapInView(const CameraModel& camera, const RegistrationSetup& setup,
                                     const RegistrationView& view, const TagPose& camera_pose) {
  if (!view.robot) return std::nullopt;
  AveragedRegistration result;
  result.pose.T_camera_world = camera_pose.T_camera_world;
  SceneProblem problem;
  for (const TagDetection& tag : view.floor) {
    if (contains(camera_pose.rejected_ids, tag.id)) continue;
    append(problem.corners, {tag}, *setup.layout.find(tag.id), false, setup.corner_bias_px);
  }
  if (!addRobot(camera, setup, {*view.robot}, problem, result)) return std::nullopt;
  return fitScene(camera, problem, result.pose);
}

bool MapAverage::add(const Isometry3d& T_world_map, const Eigen::Matrix3d& covariance_map_axes) {
  const Eigen::Matrix3d R = T_world_map.linear();
  const double turned = std::atan2(R(1, 0), R(0, 0));
  if (frames_ == 0) first_yaw_ = turned;
  const double yaw = first_yaw_ + std::remainder(turned - first_yaw_, 2 * std::numbers::pi);
  const Vector3d place(T_world_map.translation().x(), T_world_map.translation().y(), yaw);
  if (frames_ > 0) {
    const Vector3d off = place - Vector3d(solveSymmetric(information_, weighted_));
    if (off.head<2>().norm() > kMoved_m || std::abs(off.z()) > kMoved_rad) return false;
  }
  const Eigen::Matrix3d information = (R * covariance_map_axes * R.transpose()).inverse();
  information_ += information;
  weighted_ += information * place;
  ++frames_;
  return true;
}

Isometry3d MapAverage::pose() const {
  const Vector3d place = solveSymmetric(information_, weighted_);
  Isometry3d T(Eigen::Translation3d(place.x(), place.y(), 0));
  T.linear() = Eigen::AngleAxisd(place.z(), Vector3d::UnitZ()).toRotationMatrix();
  return T;
}

Eigen::Matrix3d MapAverage::covariance() const {
  const Eigen::Matrix3d R = pose().linear();
  return R.transpose() * information_.inverse() * R;
}

}  // namespace slamscope::tracking
