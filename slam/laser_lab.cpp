// SPDX-License-Identifier: MIT
#include "slam/laser_lab.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "slam/models.hpp"
#include "slam/simulation_random.hpp"

namespace slamscope::slam {
namespace {

using std::chrono::nanoseconds;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kPostRadius = 0.03;    // m
constexpr double kOdometryRate = 20.0;  // 1/s
constexpr int kOdometryPerScan = 4;     // 5 scans a second
constexpr double kSweep = 0.02;         // s
constexpr double kHalfView = 120.0 * kDegree;
constexpr double kReach = 8.0;            // m
constexpr double kGlint = 1.2 * kDegree;  // off square, a glossy wall sends nothing back

const LaserMount kMount{{0.17, 0.0, 0.0}, kSweep};

/// Where the ray meets a wall (m), and whether it comes back from there.
struct Echo {
  double range = kReach;
  bool returns = false;
};

Echo echoOf(const LaserWall& wall, const Eigen::Vector2d& origin, const Eigen::Vector2d& ray) {
  const Eigen::Vector2d along = wall.to - wall.from;
  const Eigen::Vector2d to_wall = wall.from - origin;
  const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  const double slope = cross(ray, along);
  if (slope == 0.0) return {};
  const double range = cross(to_wall, along) / slope;
  const double share = cross(to_wall, ray) / slope;
  if (!(range > 0.0 && share >= 0.0 && share <= 1.0)) return {};
  const double off_square = std::abs(ray.dot(along)) / along.norm();
  return {range, !wall.glossy || off_square < std::sin(kGlint)};
}

/// Range to the post's surface; kReach where the ray misses it.
double rangeTo(const Eigen::Vector2d& post, const Eigen::Vector2d& origin,
               const Eigen::Vector2d& ray) {
  const double along = (post - origin).dot(ray);
  const double squared = kPostRadius * kPostRadius - (post - origin - along * ray).squaredNorm();
  return along > 0.0 && squared > 0.0 ? along - std::sqrt(squared) : kReach;
}

/// One sweep, the robot driving on meanwhile.
LaserScan scanAt(const LaserLab& lab, const LaserLabOptions& options, nanoseconds time,
                 RandomSource& random) {
  LaserScan scan{.time = time,
                 .angle_min = -kHalfView,
                 .angle_step = 0.5 * kDegree,
                 .ranges = {},
                 .intensities = {}};
  std::vector<Eigen::Vector2d> posts = lab.posts().features;
  for (Eigen::Vector2d& post : posts) {
    for (double& coordinate : post) coordinate += options.sway_sigma * random.normal();
  }
  constexpr int kReturnsOfSweep = 481;
  for (std::size_t k = 0; k < kReturnsOfSweep; ++k) {
    const auto delay =
        nanoseconds(std::llround(1e9 * kSweep * static_cast<double>(k) / (kReturnsOfSweep - 1)));
    const Eigen::Vector3d laser = movePose(lab.drive().poseAt(time + delay), kMount.pose_robot);
    const double angle = laser[2] + scan.angle(k);
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    Echo nearest;
    for (const LaserWall& wall : lab.walls()) {
      const Echo echo = echoOf(wall, laser.head<2>(), ray);
      if (echo.range < nearest.range) nearest = echo;
    }
    for (const Eigen::Vector2d& post : posts) {
      const double range = rangeTo(post, laser.head<2>(), ray);
      if (range < nearest.range) nearest = {range, true};
    }
    const double noise = options.range_sigma * random.normal();
    scan.ranges.push_back(nearest.returns ? nearest.range + noise
                                          : std::numeric_limits<double>::quiet_NaN());
  }
  return scan;
}

}  // namespace

LaserLab::LaserLab(const LaserLabOptions& options)
    : options_(options),
      posts_{{1, 2, 3, 4, 5},
             {{1.20, -0.35}, {1.25, 1.05}, {0.55, 1.65}, {-0.95, 1.45}, {-1.15, -0.30}}},
      drive_({.loops = options.loops, .rate = kOdometryRate, .speed = 0.25, .rest = 1.0}) {
  if (!(options.range_sigma > 0.0) || !(options.sway_sigma >= 0.0) ||
      !(options.forward_sigma >= 0.0) || !(options.turn_sigma >= 0.0)) {
    throw std::invalid_argument("a laser lab needs range σ > 0, other σ not negative");
  }
  const double right = 2.2;
  walls_ = {{{right, -0.40}, {right, 0.45}},
            {{right, 0.45}, {right, 0.80}, options.glossy},
            {{right, 0.80}, {right, 1.90}},
            {{-2.2, -0.70}, {-2.2, 1.40}}};
  const Eigen::Vector2d corners[] = {{4.2, -2.6}, {4.2, 3.6}, {-4.2, 3.6}, {-4.2, -2.6}};
  for (int k = 0; k < 4; ++k) walls_.push_back({corners[k], corners[(k + 1) % 4]});
}

double LaserLab::postRadius() const {
  return kPostRadius;
}

Recording LaserLab::record() const {
  Recording recording;
  recording.name = "laser lab";
  recording.laser = kMount;
  recording.ids_known = false;
  recording.separation = 0.35;
  for (std::size_t k = 0; k < posts_.ids.size(); ++k) {
    recording.truth_features.emplace_back(posts_.ids[k], posts_.features[k]);
  }
  RandomSource odometry_noise(options_.seed + 1000003);
  RandomSource laser_noise(options_.seed + 2000003);
  for (int step = 0; step <= drive_.stepCount(); ++step) {
    const nanoseconds time = drive_.timeOf(step);
    recording.truth_path.push_back({time, drive_.poseAt(time)});
    if (step % kOdometryPerScan == 0) {
      recording.scans.push_back(scanAt(*this, options_, time, laser_noise));
    }
    if (step == drive_.stepCount()) break;
    // White noise of the velocity: the mean over a step is off by σ of a second over its root.
    // Wheels that stand still are read exactly.
    Eigen::Vector2d velocity = drive_.velocity(step);
    const double root = velocity.isZero() ? 0.0 : std::sqrt(kOdometryRate);
    velocity[0] += options_.forward_sigma * root * odometry_noise.normal();
    velocity[1] += options_.turn_sigma * root * odometry_noise.normal();
    recording.odometry.push_back({time, {velocity[0], 0.0, velocity[1]}});
  }
  moveTruthIntoMap(recording);
  return recording;
}

RecordingRunOptions LaserLab::runOptions() const {
  RecordingRunOptions options;
  options.association = Association::joint;
  options.odometry_sigma = {options_.forward_sigma, 0.0, options_.turn_sigma};
  options.life.separation = 0.35;
  options.life.confirm_after = 10;
  options.life.drop_after = 8;
  options.laser.max_range = kReach;
  options.laser.max_diameter = 0.15;
  options.laser.clearance = 0.4;
  options.laser.range_sigma = options_.range_sigma;
  options.laser.shape_sigma = options_.sway_sigma;
  return options;
}

}  // namespace slamscope::slam
