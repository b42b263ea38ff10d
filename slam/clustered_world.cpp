// SPDX-License-Identifier: MIT
#include "slam/clustered_world.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "slam/angle.hpp"
#include "slam/models.hpp"
#include "slam/simulation_random.hpp"

namespace slamscope::slam {
namespace {

using namespace std::chrono_literals;

constexpr double kRoomLength = 14.0;    // m
constexpr double kRoomWidth = 8.0;      // m
constexpr double kLeastDistance = 2.5;  // m, between clusters
constexpr double kPostFromMiddle = 0.15;
constexpr double kOdometryPeriod = 0.1;  // s
constexpr int kStepsPerSighting = 5;
constexpr int kStepsPerGoal = 400;  // at most

void plantClusters(const ClusteredWorldOptions& options, RandomSource& random,
                   Recording& recording) {
  std::vector<Eigen::Vector2d> middles;
  for (int tries = 0; tries < 10000 && std::ssize(middles) < options.clusters; ++tries) {
    const double x = random.uniform(1.0, kRoomLength - 1.0);
    const Eigen::Vector2d middle(x, random.uniform(1.0, kRoomWidth - 1.0));
    const bool free = std::all_of(middles.begin(), middles.end(), [&](const auto& other) {
      return (other - middle).norm() > kLeastDistance;
    });
    if (free) middles.push_back(middle);
  }
  FeatureId id = 0;
  for (std::size_t k = 0; k < middles.size(); ++k) {
    double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    for (int post = 0; post < (k < 3 ? 3 : 2); ++post) {
      angle += 2.0 * std::numbers::pi / 3.0 + random.uniform(-0.3, 0.3);
      const Eigen::Vector2d from_middle(std::cos(angle), std::sin(angle));
      recording.truth_features.emplace_back(++id, middles[k] + kPostFromMiddle * from_middle);
    }
  }
}

/// Range errors that stay, one a post.
class LastingErrors {
 public:
  explicit LastingErrors(double memory) : memory_(memory) {}

  /// In units of σ.
  double next(FeatureId id, double time, RandomSource& random) {
    Error& error = errors_[id];
    const double g = memory_ > 0.0 ? std::exp(-(time - error.time) / memory_) : 0.0;
    error = {g * error.value + std::sqrt(1.0 - g * g) * random.normal(), time};
    return error.value;
  }

 private:
  struct Error {
    double value = 0.0;
    double time = -1e9;  ///< s
  };
  double memory_;
  std::map<FeatureId, Error> errors_;
};

void lookAhead(const ClusteredWorldOptions& options, const TimedPose& truth, RandomSource& random,
               LastingErrors& errors, Recording& recording) {
  for (const auto& [id, feature] : recording.truth_features) {
    Eigen::Vector2d z = observeFeature(Sensor::range_bearing, truth.pose, feature);
    const bool in_view =
        z[0] > 0.5 && z[0] < options.sensor_range && std::abs(z[1]) < options.half_angle;
    if (!in_view || random.uniform() > options.seen_share) continue;
    const double range_sigma = options.error.range_sigma + options.error.range_share * z[0];
    z[0] += range_sigma * errors.next(id, seconds(truth.time), random);
    z[1] += options.error.bearing_sigma * random.normal();
    addSighting(recording, truth.time, {id, z});
  }
}

/// (forward m/s, turn rad/s) towards a goal: first turn, then go.
Eigen::Vector2d steerTo(const Eigen::Vector2d& goal, const Eigen::Vector3d& pose) {
  const Eigen::Vector2d way = goal - pose.head<2>();
  const double turn = wrapAngle(std::atan2(way.y(), way.x()) - pose[2]);
  return {std::abs(turn) < 0.5 ? 0.15 : 0.02, std::clamp(turn, -0.5, 0.5)};
}

}  // namespace

Recording recordClusteredWorld(const ClusteredWorldOptions& options) {
  Recording recording;
  recording.name = "clustered world";
  RandomSource random(options.seed);
  plantClusters(options, random, recording);
  LastingErrors errors(options.error.memory);
  TimedPose truth{0ns, {kRoomLength / 2.0, 0.5, std::numbers::pi / 2.0}};
  Eigen::Vector2d goal(kRoomLength / 2.0, kRoomWidth / 2.0);
  const int steps = static_cast<int>(options.duration_s / kOdometryPeriod);
  for (int k = 0; k < steps; ++k) {
    truth.time = k * 100ms;
    recording.truth_path.push_back(truth);
    if ((goal - truth.pose.head<2>()).norm() < 0.3 || k % kStepsPerGoal == 0) {
      const double x = random.uniform(0.5, kRoomLength - 0.5);
      goal = {x, random.uniform(0.5, kRoomWidth - 0.5)};
    }
    const Eigen::Vector2d velocity = steerTo(goal, truth.pose);
    const double slip = options.slip_sigma * std::sqrt(std::abs(velocity[1]));
    const double root = std::sqrt(kOdometryPeriod);
    const double forward = velocity[0] + options.forward_sigma / root * random.normal();
    const double turn = velocity[1] + std::hypot(options.turn_sigma, slip) / root * random.normal();
    recording.odometry.push_back({truth.time, {forward, 0.0, turn}});
    if (k % kStepsPerSighting == 0) lookAhead(options, truth, random, errors, recording);
    truth.pose = movePose(truth.pose, arcIncrement(velocity, kOdometryPeriod));
  }
  moveTruthIntoMap(recording);
  return recording;
}

}  // namespace slamscope::slam
