// SPDX-License-Identifier: MIT
#include "slam/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "slam/models.hpp"
#include "slam/simulation_random.hpp"

namespace slamscope::slam {
namespace {

constexpr double kHalfLoop = 0.5;        // m
constexpr double kCornerRadius = 0.2;    // m
constexpr double kClearance = 0.2;       // m, features off the robot's path
constexpr double kHalfFloor = 1.4;       // m, of a uniform world
constexpr double kClusterRadius = 0.3;   // m
constexpr double kClusterOffset = 1.15;  // m, from the loop's centre

constexpr std::array<std::pair<WorldKind, std::string_view>, 3> kWorldNames{{
    {WorldKind::three_clusters, "three-clusters"},
    {WorldKind::uniform, "uniform"},
    {WorldKind::one_cluster, "one-cluster"},
}};

/// Distance of a point (relative to the loop's centre) from the line that the robot drives.
double distanceToLoop(const Eigen::Vector2d& p) {
  const Eigen::Array2d q = p.array().abs() - (kHalfLoop - kCornerRadius);
  const double outside = q.max(0.0).matrix().norm();
  return std::abs(outside + std::min(q.maxCoeff(), 0.0) - kCornerRadius);
}

/// Draws points one by one, each at least `separation` from all the others.
template <typename Draw>
void scatter(World& world, int count, double separation, Draw draw) {
  for (int k = 0, attempts = 0; k < count;) {
    const Eigen::Vector2d candidate = draw();
    const bool free = std::all_of(
        world.features.begin(), world.features.end(),
        [&](const Eigen::Vector2d& feature) { return (feature - candidate).norm() >= separation; });
    if (free) {
      world.features.push_back(candidate);
      ++k;
      attempts = 0;
    } else if (++attempts == 1000) {  // full at this spacing
      separation *= 0.7;
      attempts = 0;
    }
  }
}

void scatterDisc(World& world, int count, const Eigen::Vector2d& centre, RandomSource& random) {
  if (count == 0) return;
  // Three tenths of the disc are covered at most: dense enough to be lively, quick to draw.
  const double separation = std::min(0.15, 2.0 * kClusterRadius * std::sqrt(0.3 / count));
  scatter(world, count, separation, [&]() -> Eigen::Vector2d {
    const double radius = kClusterRadius * std::sqrt(random.uniform());
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    return centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  });
}

void scatterFloor(World& world, int count, RandomSource& random) {
  scatter(world, count, std::min(0.25, 1.5 / std::sqrt(count)), [&]() -> Eigen::Vector2d {
    Eigen::Vector2d p;
    do {
      p.x() = random.uniform(-kHalfFloor, kHalfFloor);
      p.y() = random.uniform(-kHalfFloor, kHalfFloor);
    } while (distanceToLoop(p) < kClearance);
    return kLoopCentre + p;
  });
}

/// The first cluster is the only one in view at the start (ahead, slightly to the right); the
/// others come into view as the robot turns its corners.
Eigen::Vector2d clusterCentre(int cluster) {
  const double angle = (-30.0 + 120.0 * cluster) * std::numbers::pi / 180.0;
  return kLoopCentre + kClusterOffset * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

}  // namespace

std::string_view worldName(WorldKind kind) {
  return std::find_if(kWorldNames.begin(), kWorldNames.end(),
                      [kind](const auto& known) { return known.first == kind; })
      ->second;
}

WorldKind worldFromName(std::string_view name) {
  for (const auto& [kind, known] : kWorldNames) {
    if (known == name) return kind;
  }
  throw std::invalid_argument("no world of the name '" + std::string(name) +
                              "'; known: three-clusters, uniform, one-cluster");
}

World makeWorld(WorldKind kind, int count, std::uint64_t seed) {
  if (count < 1) {
    throw std::invalid_argument("a world needs at least one feature, got " + std::to_string(count));
  }
  RandomSource random(seed);
  World world;
  switch (kind) {
    case WorldKind::three_clusters:
      for (int cluster = 0; cluster < 3; ++cluster) {
        const int share = count * (cluster + 1) / 3 - count * cluster / 3;
        scatterDisc(world, share, clusterCentre(cluster), random);
      }
      break;
    case WorldKind::uniform:
      scatterFloor(world, count, random);
      break;
    case WorldKind::one_cluster:
      scatterDisc(world, count, clusterCentre(0), random);
      break;
  }
  for (int k = 1; k <= count; ++k) world.ids.push_back(static_cast<FeatureId>(k));
  return world;
}

LoopDrive::LoopDrive(const Options& options) : rate_(options.rate) {
  if (options.loops < 0 || !(options.rate > 0.0) || !(options.speed > 0.0) ||
      !(options.rest >= 0.0)) {
    throw std::invalid_argument(
        "a loop drive needs loops ≥ 0, rate > 0, speed > 0, rest ≥ 0; got " +
        std::to_string(options.loops) + ", " + std::to_string(options.rate) + ", " +
        std::to_string(options.speed) + ", " + std::to_string(options.rest));
  }
  poses_.emplace_back(0.0, 0.0, 0.0);
  const auto drive = [&](double distance, double angle, double seconds) {
    const int steps = std::max(1, static_cast<int>(std::lround(seconds * options.rate)));
    const Eigen::Vector2d velocity = Eigen::Vector2d(distance, angle) * options.rate / steps;
    for (int k = 0; k < steps; ++k) {
      velocities_.push_back(velocity);
      poses_.push_back(movePose(poses_.back(), arcIncrement(velocity, 1.0 / options.rate)));
    }
  };
  const double side = 2.0 * (kHalfLoop - kCornerRadius);
  const double turn = std::numbers::pi / 2.0;
  const double arc = kCornerRadius * turn;
  if (options.rest * options.rate >= 0.5) drive(0.0, 0.0, options.rest);
  for (int loop = 0; loop < options.loops; ++loop) {
    for (const double straight : {side / 2.0, side, side, side}) {
      drive(straight, 0.0, straight / options.speed);
      drive(arc, turn, arc / options.speed);
    }
    drive(side / 2.0, 0.0, side / 2.0 / options.speed);
  }
}

std::chrono::nanoseconds LoopDrive::timeOf(int step) const {
  return std::chrono::nanoseconds(std::llround(static_cast<double>(step) * 1e9 / rate_));
}

Eigen::Vector3d LoopDrive::poseAt(std::chrono::nanoseconds time) const {
  const double steps = static_cast<double>(time.count()) * 1e-9 * rate_;
  if (steps <= 0.0) return poses_.front();
  if (steps >= stepCount()) return poses_.back();
  const int step = static_cast<int>(steps);
  return movePose(pose(step), arcIncrement(velocity(step), (steps - step) / rate_));
}

}  // namespace slamscope::slam
