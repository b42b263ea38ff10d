// SPDX-License-Identifier: MIT
#include "slam/ambiguous_world.hpp"

#include <cmath>
#include <numbers>

#include "slam/models.hpp"
#include "slam/simulation_random.hpp"

namespace slamscope::slam {
namespace {

using namespace std::chrono_literals;

constexpr double kRadius = 6.0;          // m, of the drive
constexpr double kSpeed = 0.75;          // m/s
constexpr int kOdometryPerSighting = 4;  // 4 a second

/// Pairs on a wide ring round the drive, each turned at random.
void plantPairs(const AmbiguousWorldOptions& options, Recording& recording) {
  RandomSource random(options.seed);
  for (int pair = 0; pair < options.pairs; ++pair) {
    const double around =
        2.0 * std::numbers::pi * (pair + random.uniform(-0.3, 0.3)) / options.pairs;
    const double radius = random.uniform(kRadius + 1.5, kRadius + 4.0);
    const double turned = random.uniform(0.0, std::numbers::pi);
    const Eigen::Vector2d middle(radius * std::cos(around), kRadius + radius * std::sin(around));
    const Eigen::Vector2d half =
        0.5 * options.spacing * Eigen::Vector2d(std::cos(turned), std::sin(turned));
    recording.truth_features.emplace_back(static_cast<FeatureId>(2 * pair + 1), middle - half);
    recording.truth_features.emplace_back(static_cast<FeatureId>(2 * pair + 2), middle + half);
  }
}

void lookAround(const AmbiguousWorldOptions& options, const TimedPose& truth, RandomSource& random,
                Recording& recording) {
  for (const auto& [id, feature] : recording.truth_features) {
    Eigen::Vector2d z = observeFeature(Sensor::range_bearing, truth.pose, feature);
    if (z[0] > options.sensor_range || std::abs(z[1]) > std::numbers::pi / 2.0) continue;
    for (int axis = 0; axis < 2; ++axis) z[axis] += options.sensor_sigma[axis] * random.normal();
    addSighting(recording, truth.time, {id, z});
  }
}

}  // namespace

Recording recordAmbiguousWorld(const AmbiguousWorldOptions& options) {
  Recording recording;
  recording.name = "ambiguous world";
  plantPairs(options, recording);
  RandomSource odometry_noise(options.seed + 1000003);
  RandomSource sensor_noise(options.seed + 2000003);
  const double period = 1.0 / kOdometryPerSighting;
  const Eigen::Vector2d velocity(kSpeed, kSpeed / kRadius);
  const double length = options.loops * 2.0 * std::numbers::pi * kRadius;
  const int steps = static_cast<int>(length / kSpeed / period);
  TimedPose truth;
  for (int k = 0; k <= steps; ++k) {
    truth.time = k * (1000ms / kOdometryPerSighting);
    recording.truth_path.push_back(truth);
    // White noise of the velocity: the mean over a period is off by σ of a second over its root.
    const double forward =
        velocity[0] + options.forward_sigma / std::sqrt(period) * odometry_noise.normal();
    const double turn =
        velocity[1] + options.turn_sigma / std::sqrt(period) * odometry_noise.normal();
    recording.odometry.push_back({truth.time, {forward, 0.0, turn}});
    if (k % kOdometryPerSighting == 0) lookAround(options, truth, sensor_noise, recording);
    truth.pose = movePose(truth.pose, arcIncrement(velocity, period));
  }
  moveTruthIntoMap(recording);
  return recording;
}

RecordingRunOptions ambiguousWorldRun(const AmbiguousWorldOptions& world, Association association,
                                      int hypotheses) {
  RecordingRunOptions options;
  options.association = association;
  options.sensor_sigma = world.sensor_sigma;
  options.odometry_sigma = {world.forward_sigma, 0.001, world.turn_sigma};
  options.hypotheses.most = hypotheses;
  options.hypotheses.odometry_sigma = options.odometry_sigma;
  options.hypotheses.turn_sigma = 0.0;
  options.hypotheses.view = {world.sensor_range, std::numbers::pi / 2.0};
  options.hypotheses.error = {.range_sigma = world.sensor_sigma[0],
                              .range_share = 0.0,
                              .bearing_sigma = world.sensor_sigma[1],
                              .memory = 0.0,
                              .slow_memory = 0.0,
                              .jump_share = 0.0};
  return options;
}

}  // namespace slamscope::slam
