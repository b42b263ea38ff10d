// SPDX-License-Identifier: MIT
#include "slam/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "slam/faults.hpp"

namespace slamscope::slam {
namespace {

/// Independent sequences from one seed (the finaliser of splitmix64).
enum class Stream : std::uint64_t { world, odometry, sensor, start, fault };

std::uint64_t streamSeed(std::uint64_t seed, Stream stream) {
  std::uint64_t z = seed + (static_cast<std::uint64_t>(stream) + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

Eigen::Vector2d sensorSigma(const SimulationOptions& options) {
  const Eigen::Vector2d by_default = options.sensor == Sensor::relative_position
                                         ? Eigen::Vector2d(0.05, 0.05)
                                         : Eigen::Vector2d(0.06, 0.04);
  return options.sensor_sigma.value_or(by_default);
}

const SimulationOptions& checked(const SimulationOptions& options) {
  const Eigen::Vector2d sigma = sensorSigma(options);
  if (!(sigma.minCoeff() > 0.0) || !(options.odometry_sigma.minCoeff() >= 0.0) ||
      !(options.initial_sigma.minCoeff() >= 0.0) || !(options.sensor_range > 0.0) ||
      !(options.field_of_view > 0.0)) {
    throw std::invalid_argument(
        "a simulation needs sensor σ > 0, odometry σ ≥ 0, initial σ ≥ 0, range > 0, view > 0");
  }
  return options;
}

EkfOptions filterOptions(const SimulationOptions& options) {
  EkfOptions result;
  result.sensor = options.sensor;
  result.update = options.update;
  result.gate_probability = options.gate_probability;
  result.record_jacobians = options.record_jacobians;
  RandomSource random(streamSeed(options.seed, Stream::start));
  for (int k = 0; k < 3; ++k) result.initial_pose[k] = options.initial_sigma[k] * random.normal();
  result.initial_covariance = options.initial_sigma.array().square().matrix().asDiagonal();
  return result;
}

std::vector<FeatureId> faultFeaturesOf(const SimulationOptions& options) {
  std::vector<FeatureId> features = options.fault_features;
  if (features.empty()) {
    const auto at = [&](double share) {
      return 1 + static_cast<FeatureId>(share * options.features);
    };
    features =
        featureMove(options.fault) ? std::vector{at(0.5)} : std::vector{at(0.1), at(0.5), at(0.9)};
  }
  std::sort(features.begin(), features.end());
  features.erase(std::unique(features.begin(), features.end()), features.end());
  return features;
}

std::unique_ptr<EkfEquations> equationsOf(const SimulationOptions& options) {
  return makeFault(options.fault, {options.sensor, faultFeaturesOf(options),
                                   streamSeed(options.seed, Stream::fault)});
}

Truth startTruth(const SimulationOptions& options) {
  World world = makeWorld(options.world, options.features, streamSeed(options.seed, Stream::world));
  return {Eigen::Vector3d::Zero(), std::move(world.ids), std::move(world.features)};
}

}  // namespace

Simulation::Simulation(const SimulationOptions& options)
    : Simulation(options, equationsOf(options)) {}

Simulation::Simulation(const SimulationOptions& options, std::unique_ptr<EkfEquations> equations)
    : options_(checked(options)),
      R_(sensorSigma(options).array().square().matrix().asDiagonal()),
      drive_({options.loops, options.rate, options.speed, options.rest}),
      truth_(startTruth(options)),
      odometry_noise_(streamSeed(options.seed, Stream::odometry)),
      sensor_noise_(streamSeed(options.seed, Stream::sensor)),
      filter_(filterOptions(options), std::move(equations)) {
  static_cast<void>(faultNamed(options.fault));  // throws where there is none of that name
}

bool Simulation::step() {
  if (next_step_ > drive_.stepCount()) return false;
  if (const auto move = featureMove(options_.fault);
      move && next_step_ == static_cast<int>(move->at * drive_.stepCount())) {
    moveFeatures();
  }
  truth_.pose = drive_.pose(next_step_);
  const std::chrono::nanoseconds time = drive_.timeOf(next_step_);
  if (next_step_ == 0) {
    filter_.setTruth(truth_);
    filter_.start(time);
    filter_.observe(time, readings());
  } else {
    const Motion motion = odometry(next_step_ - 1);
    filter_.setTruth(truth_);
    filter_.step(time, motion, readings());
  }
  ++next_step_;
  return true;
}

double Simulation::progress() const {
  return static_cast<double>(next_step_) / (drive_.stepCount() + 1);
}

std::vector<FeatureId> Simulation::faultFeatures() const {
  return faultFeaturesOf(options_);
}

void Simulation::moveFeatures() {
  const double distance = featureMove(options_.fault)->distance;
  for (const FeatureId id : faultFeatures()) {
    const auto found = std::find(truth_.ids.begin(), truth_.ids.end(), id);
    if (found == truth_.ids.end()) continue;
    Eigen::Vector2d& feature =
        truth_.features[static_cast<std::size_t>(found - truth_.ids.begin())];
    feature += distance * (feature - kLoopCentre).normalized();
  }
}

RunHeader Simulation::header() const {
  RunHeader header;
  header.sensor = options_.sensor;
  header.robot = "simulated";
  header.R = R_;
  return header;
}

Motion Simulation::odometry(int step) {
  const Eigen::Vector2d velocity = drive_.velocity(step);
  const double duration = 1.0 / options_.rate;
  // The robot keeps to its loop and the odometry is what errs, so that any number of loops stays in
  // the camera's view. Wheels that stand still are read exactly.
  if (options_.motion == MotionInput::increment) return increments(velocity, duration);
  if (velocity.isZero()) return Motion::fromVelocity(0.0, 0.0, duration, Eigen::Matrix2d::Zero());
  if (options_.motion == MotionInput::ackermann) return steered(velocity, duration);
  const Eigen::Vector2d& sigma = options_.odometry_sigma;
  const double forward = velocity[0] + sigma[0] * odometry_noise_.normal();
  const double turn = velocity[1] + sigma[1] * odometry_noise_.normal();
  return Motion::fromVelocity(forward, turn, duration,
                              sigma.array().square().matrix().asDiagonal());
}

Motion Simulation::increments(const Eigen::Vector2d& velocity, double duration) {
  if (velocity.isZero())
    return Motion::fromIncrement(Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero());
  const Eigen::Vector2d sigma = duration * options_.odometry_sigma;
  const Eigen::Vector3d sigmas(sigma[0], sigma[0], sigma[1]);
  Eigen::Vector3d increment = arcIncrement(velocity, duration);
  for (int k = 0; k < 3; ++k) increment[k] += sigmas[k] * odometry_noise_.normal();
  return Motion::fromIncrement(increment, sigmas.array().square().matrix().asDiagonal());
}

Motion Simulation::steered(const Eigen::Vector2d& velocity, double duration) {
  constexpr AckermannGeometry kCar{.wheelbase = 0.3};
  const Eigen::Vector2d& sigma = options_.odometry_sigma;
  Eigen::Vector2d control(velocity[0], std::atan2(kCar.wheelbase * velocity[1], velocity[0]));
  for (int k = 0; k < 2; ++k) control[k] += sigma[k] * odometry_noise_.normal();
  Eigen::Matrix2d J;
  const Eigen::Vector2d read = ackermannVelocity(kCar, control, &J);
  const Eigen::Matrix2d variance = sigma.array().square().matrix().asDiagonal();
  Motion motion = Motion::fromVelocity(read[0], read[1], duration, J * variance * J.transpose());
  motion.control = control;
  return motion;
}

std::vector<Observation> Simulation::readings() {
  std::vector<Observation> readings;
  for (std::size_t k = 0; k < truth_.ids.size(); ++k) {
    if (!inView(truth_.features[k])) continue;
    Eigen::Vector2d z = observeFeature(options_.sensor, truth_.pose, truth_.features[k]);
    for (int axis = 0; axis < 2; ++axis) {
      z[axis] += std::sqrt(R_(axis, axis)) * sensor_noise_.normal();
    }
    readings.push_back({truth_.ids[k], z, R_});
  }
  return readings;
}

bool Simulation::inView(const Eigen::Vector2d& feature) const {
  const Eigen::Vector2d range_bearing = observeFeature(Sensor::range_bearing, truth_.pose, feature);
  return range_bearing[0] <= options_.sensor_range &&
         std::abs(range_bearing[1]) <= options_.field_of_view / 2.0;
}

}  // namespace slamscope::slam
