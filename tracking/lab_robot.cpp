// SPDX-License-Identifier: MIT
#include "tracking/lab_robot.hpp"

#include <cmath>

namespace slamscope::tracking::lab {
namespace {

constexpr double kBodyRadius = 0.18, kBodyHeight = 0.16;  // as far as light is concerned, m
constexpr int kTagPart = 1, kWheelPart = 10, kBlockPart = 100;

/// Bright part of a sonar's ring, by place on the rim.
bool isSonar(const Eigen::Vector3d& p) {
  const double angle = std::atan2(p.y(), p.x());
  if (std::abs(angle) > 1.75 || p.z() < 0.10 || p.z() > 0.135) return false;
  const double turn = angle / 0.35;
  return std::abs(turn - std::round(turn)) < 0.27;
}

}  // namespace

Robot::Robot(const LabOptions& options)
    : tag_(options.robot_tag_id, options.robot_tag_size),
      T_tag_robot_(options.T_robot_tag.inverse()) {
  const Eigen::Vector3d tag = options.T_robot_tag.translation();
  const Eigen::Array3f orange(38, 104, 232), charcoal(58, 54, 52), steel(140, 138, 134);
  blocks_ = {
      {makeBox({0, 0}, {0.20, 0.14}, 0.05, 0.13, 0, 0.09), orange},
      {makeBox({0, 0}, {0.21, 0.155}, 0.13, 0.14, 0, 0.09), charcoal},
      {makeBox({-0.195, 0}, {0.02, 0.07}, 0.03, 0.10), charcoal},
      {makeBox({0.165, 0}, {0.035, 0.05}, 0.14, 0.185, 0, 0.03), Eigen::Array3f(150, 96, 40)},
  };
  if (tag.z() > 0.145)
    blocks_.push_back({makeBox(tag.head<2>(), {0.02, 0.02}, 0.14, tag.z() - 1e-4), steel});
  for (const double side : {-1.0, 1.0})
    wheels_.push_back(
        {.centre = {0, side * 0.165, 0.085}, .radius = 0.085, .half_length = 0.022, .axis = 1});
}

Sample Robot::trace(const Ray& ray_robot, const Eigen::Isometry3d& T_world_robot) const {
  Sample nearest;
  Eigen::Array3f paint = Eigen::Array3f::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  if (const TagFace::TagHit hit = tag_.intersect(T_tag_robot_ * ray_robot)) {
    nearest.t = hit.t;
    nearest.part = kTagPart + (hit.ink == TagFace::Ink::white ? 1 : 0);
    paint = albedo(hit.ink);
    normal = T_tag_robot_.linear().row(2).transpose();
  }
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const Hit hit = intersect(ray_robot, wheels_[i]);
    if (hit.t >= nearest.t) continue;
    const bool flank = std::abs(hit.normal.y()) > 0.5;
    nearest.t = hit.t;
    nearest.part = kWheelPart + 2 * static_cast<int>(i) + (flank ? 1 : 0);
    paint = flank ? Eigen::Array3f(120, 120, 120) : Eigen::Array3f(40, 39, 38);
    normal = hit.normal;
  }
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const Hit hit = intersect(ray_robot, blocks_[i].shape);
    if (hit.t >= nearest.t) continue;
    nearest.t = hit.t;
    normal = hit.normal;
    const bool sonar = i == 0 && normal.z() < 0.5 && isSonar(ray_robot.at(hit.t));
    nearest.part = kBlockPart + 16 * static_cast<int>(i) +
                   (sonar ? 15
                          : static_cast<int>(std::lround(4 * std::atan2(normal.y(), normal.x()) +
                                                         4 * normal.z())) &
                                7);
    paint = sonar ? Eigen::Array3f(90, 180, 214) : blocks_[i].albedo;
  }
  if (nearest.part < 0) return nearest;
  const Eigen::Vector3d p = ray_robot.at(nearest.t);
  // The tag's board keeps light from the deck below it.
  const Eigen::Vector3d p_tag = T_tag_robot_ * p;
  const double beside = p_tag.head<2>().cwiseAbs().maxCoeff() - tag_.halfPaper();
  const auto shade = static_cast<float>(
      p_tag.z() < -0.005 ? 1 - 0.55 / (1 + std::exp(beside / (0.012 + 0.2 * std::abs(p_tag.z()))))
                         : 1);
  nearest.colour =
      paint * shade * tint(openLight(T_world_robot * p, T_world_robot.linear() * normal));
  return nearest;
}

Blocker Robot::blocker(const Eigen::Isometry3d& T_world_robot) {
  return {.p_world = T_world_robot.translation().head<2>(),
          .radius = kBodyRadius,
          .height = kBodyHeight,
          .contact = 0.045};
}

std::vector<Eigen::Vector3d> Robot::bounds() const {
  Eigen::Vector3d lower(-0.23, -0.20, 0), upper(0.23, 0.20, 0.19);
  const Eigen::Isometry3d T_robot_tag = T_tag_robot_.inverse();
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      const Eigen::Vector3d p =
          T_robot_tag * Eigen::Vector3d(x * tag_.halfPaper(), y * tag_.halfPaper(), 0);
      lower = lower.cwiseMin(p);
      upper = upper.cwiseMax(p);
    }
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back((i & 1) != 0 ? upper.x() : lower.x(), (i & 2) != 0 ? upper.y() : lower.y(),
                         (i & 4) != 0 ? upper.z() : lower.z());
  return corners;
}

}  // namespace slamscope::tracking::lab
