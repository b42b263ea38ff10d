// SPDX-License-Identifier: MIT
#include "tracking/lab_robot.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace slamscope::tracking::lab {
namespace {

constexpr double kTop = 0.19;                             // of all but the tag, m
constexpr double kBodyRadius = 0.18, kBodyHeight = 0.16;  // as far as light is concerned, m
constexpr int kTagBlack = 1, kTagWhite = 2, kWheelPart = 10, kBlockPart = 100;
constexpr int kSonar = 15;  // of one block

/// Bright part of a sonar's ring, by place on the rim.
bool isSonar(const Eigen::Vector3d& p) {
  const double angle = std::atan2(p.y(), p.x());
  if (std::abs(angle) > 1.75 || p.z() < 0.10 || p.z() > 0.135) return false;
  const double turn = angle / 0.35;
  return std::abs(turn - std::round(turn)) < 0.27;
}

/// Which face of a block, so that edges between faces are seen as edges: 0..8.
int faceOf(const Eigen::Vector3d& normal) {
  if (std::abs(normal.z()) > 0.5) return 8;
  return static_cast<int>(
             std::lround(std::atan2(normal.y(), normal.x()) / (std::numbers::pi / 4))) &
         7;
}

}  // namespace

Robot::Robot(const LabOptions& options)
    : tag_(options.robot_tag_id, options.robot_tag_size),
      T_tag_robot_(options.T_robot_tag.inverse()) {
  const Eigen::Array3f orange(30, 112, 240), charcoal(56, 52, 50), steel(150, 148, 144),
      blue(178, 112, 40);
  blocks_ = {
      {makeBox({0, 0}, {0.205, 0.150}, 0.05, 0.13, 0, 0.07), orange},
      {makeBox({0, 0}, {0.170, 0.118}, 0.13, 0.137, 0, 0.05), charcoal},
      {makeBox({0.212, 0}, {0.010, 0.085}, 0.04, 0.11), charcoal},
      {makeBox({-0.212, 0}, {0.010, 0.085}, 0.04, 0.11), charcoal},
      {makeBox({0.172, 0}, {0.030, 0.042}, 0.13, kTop, 0, 0.02), blue},
  };
  const Eigen::Vector3d tag = options.T_robot_tag.translation();
  if (tag.z() > 0.14)
    blocks_.push_back({makeBox(tag.head<2>(), {0.02, 0.02}, 0.137, tag.z() - 1e-4), steel});
  for (const double side : {-1.0, 1.0})
    wheels_.push_back(
        {.centre = {0, side * 0.170, 0.085}, .radius = 0.085, .half_length = 0.022, .axis = 1});

  Eigen::Vector3d lower(-0.23, -0.20, 0), upper(0.23, 0.20, kTop);
  const double half = tag_.halfPaper();
  for (const auto& [x, y] : {std::pair{-half, -half}, {half, -half}, {half, half}, {-half, half}}) {
    const Eigen::Vector3d p = options.T_robot_tag * Eigen::Vector3d(x, y, 0);
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  for (int i = 0; i < 8; ++i)
    bounds_.emplace_back((i & 1) != 0 ? upper.x() : lower.x(), (i & 2) != 0 ? upper.y() : lower.y(),
                         (i & 4) != 0 ? upper.z() : lower.z());
  ball_ = {(lower + upper) / 2, 1.001 * (upper - lower).norm() / 2};
  tag_on_top_ = T_tag_robot_.linear()(2, 2) > 1 - 1e-9 && tag.z() > kTop;
}

void Robot::traceTag(const Ray& ray, Sight& nearest) const {
  const TagFace::TagHit hit = tag_.intersect(T_tag_robot_ * ray);
  if (!hit) return;
  nearest = {.part = hit.ink == TagFace::Ink::white ? kTagWhite : kTagBlack,
             .t = hit.t,
             .normal = T_tag_robot_.linear().row(2).transpose()};
}

void Robot::traceBody(const Ray& ray, Sight& nearest) const {
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const Hit hit = intersect(ray, wheels_[i]);
    if (hit.t >= nearest.t) continue;
    const bool flank = std::abs(hit.normal.y()) > 0.5;
    nearest = {.part = kWheelPart + 2 * static_cast<int>(i) + (flank ? 1 : 0),
               .t = hit.t,
               .normal = hit.normal};
  }
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const Hit hit = intersect(ray, blocks_[i].shape);
    if (hit.t >= nearest.t) continue;
    const bool sonar = i == 0 && hit.normal.z() < 0.5 && isSonar(ray.at(hit.t));
    nearest = {
        .part = kBlockPart + 16 * static_cast<int>(i) + (sonar ? kSonar : faceOf(hit.normal)),
        .t = hit.t,
        .normal = hit.normal};
  }
}

Sight Robot::trace(const Ray& ray_robot) const {
  Sight nearest;
  if (!ball_.mayBeHit(ray_robot)) return nearest;
  traceTag(ray_robot, nearest);
  // Nothing hides a level tag above all the rest.
  if (nearest.part < 0 || !tag_on_top_) traceBody(ray_robot, nearest);
  return nearest;
}

Eigen::Array3f Robot::paint(int part) const {
  if (part < kWheelPart)
    return albedo(part == kTagWhite ? TagFace::Ink::white : TagFace::Ink::black);
  if (part < kBlockPart) {
    const bool flank = (part - kWheelPart) % 2 == 1;
    return flank ? Eigen::Array3f(130, 130, 130) : Eigen::Array3f(44, 42, 41);
  }
  const int block = part - kBlockPart;
  if (block % 16 == kSonar) return {90, 180, 214};
  return blocks_[static_cast<std::size_t>(block) / 16].albedo;
}

Eigen::Array3f Robot::colour(const Ray& ray_robot, const Sight& sight,
                             const Eigen::Isometry3d& T_world_robot) const {
  const Eigen::Vector3d p = ray_robot.at(sight.t), p_tag = T_tag_robot_ * p;
  const Light light = openLight(T_world_robot * p, T_world_robot.linear() * sight.normal);
  Eigen::Array3f colour = paint(sight.part) * tint(light);
  if (p_tag.z() < -0.005) {
    // The tag's board keeps light from the deck below it.
    const double beside = p_tag.head<2>().cwiseAbs().maxCoeff() - tag_.halfPaper();
    colour *= static_cast<float>(1 - 0.5 / (1 + std::exp(beside / (0.01 - 0.15 * p_tag.z()))));
  }
  return colour;
}

Blocker Robot::blocker(const Eigen::Isometry3d& T_world_robot) {
  return {.p_world = T_world_robot.translation().head<2>(),
          .radius = kBodyRadius,
          .height = kBodyHeight,
          .contact = 0.045};
}

}  // namespace slamscope::tracking::lab
