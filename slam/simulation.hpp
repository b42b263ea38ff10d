// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "slam/ekf_slam.hpp"
#include "slam/simulation_random.hpp"
#include "slam/world.hpp"

namespace slamscope::slam {

/// What the odometry reports: (forward, turn) velocities; how far the robot came since the last
/// time step (dx, dy, dθ in its frame); or speed and steering of a car with 0.3 m from axle to
/// axle.
enum class MotionInput { velocity, increment, ackermann };

struct SimulationOptions {
  WorldKind world = WorldKind::three_clusters;
  int features = 15;
  int loops = 3;
  std::uint64_t seed = 1;
  std::string fault = "none";  ///< a name of faultNames()
  /// See FaultOptions::features. Default: `paper` one feature in each third of the ids (in each
  /// cluster of the paper's map), `moved-feature` the middle one of these.
  std::vector<FeatureId> fault_features{};
  /// σ of the start pose: x, y (m), θ (rad). Where not zero the estimate starts off by a draw.
  Eigen::Vector3d initial_sigma = Eigen::Vector3d::Zero();
  UpdateMode update = UpdateMode::batch;
  std::optional<double> gate_probability{};
  Sensor sensor = Sensor::range_bearing;
  /// σ of a reading: range (m) and bearing (rad), or x and y (m) for Sensor::relative_position.
  /// Default: 0.06 m and 0.04 rad, or 0.05 m twice.
  std::optional<Eigen::Vector2d> sensor_sigma{};
  MotionInput motion = MotionInput::velocity;
  /// σ of forward (m/s) and turn (rad/s), of a car of speed and steering (rad); none at rest. Of an
  /// increment: these times the time step, the first of them sideways too.
  Eigen::Vector2d odometry_sigma{0.03, 0.06};
  double rate = 10.0;                         ///< time steps and readings, 1/s
  double speed = 0.25;                        ///< m/s
  double rest = 1.0;                          ///< s at the start
  double sensor_range = 2.0;                  ///< m
  double field_of_view = 2.0943951023931953;  ///< rad, centred on the heading (120°)
  bool record_jacobians = false;
};

/// The paper's simulated experiment (section 4): a robot drives its loop, its EKF-SLAM filter
/// listens. One time step a call, so that viewer, recorder and headless runs share it. The frame of
/// the map is the robot's true pose at the start; every snapshot carries the truth.
///
/// Reproducible: options give the run. World, odometry and sensor noise are drawn from separate
/// sequences, so the same seed keeps them when the filter's settings change.
class Simulation {
 public:
  /// Throws std::invalid_argument for options out of range or an unknown fault.
  explicit Simulation(const SimulationOptions& options);
  /// With a filter of these equations; `options.fault` is planted in the world only.
  Simulation(const SimulationOptions& options, std::unique_ptr<EkfEquations> equations);

  /// The Subject to observe; attach before the first step().
  [[nodiscard]] EkfSlam& filter() { return filter_; }
  [[nodiscard]] const EkfSlam& filter() const { return filter_; }

  /// The first call publishes `initial` and takes the readings at the start; each later one drives
  /// a time step on. False, and nothing done, when the run is over.
  bool step();

  [[nodiscard]] double progress() const;  ///< 0 … 1
  [[nodiscard]] const Truth& truth() const { return truth_; }
  /// True pose (x, y, θ) at any time of the run, between time steps too.
  [[nodiscard]] Eigen::Vector3d truePose(std::chrono::nanoseconds time) const {
    return drive_.poseAt(time);
  }
  [[nodiscard]] std::chrono::nanoseconds duration() const {
    return drive_.timeOf(drive_.stepCount());
  }
  [[nodiscard]] std::chrono::nanoseconds timeStep() const { return drive_.timeOf(1); }
  /// What the fault is to be pinned on where it is one of certain features, sorted.
  [[nodiscard]] std::vector<FeatureId> faultFeatures() const;
  [[nodiscard]] RunHeader header() const;
  [[nodiscard]] const SimulationOptions& options() const { return options_; }

 private:
  void moveFeatures();
  [[nodiscard]] Motion odometry(int step);
  [[nodiscard]] Motion increments(const Eigen::Vector2d& velocity, double duration);
  [[nodiscard]] Motion steered(const Eigen::Vector2d& velocity, double duration);
  [[nodiscard]] std::vector<Observation> readings();
  [[nodiscard]] bool inView(const Eigen::Vector2d& feature) const;

  SimulationOptions options_;
  Eigen::Matrix2d R_;
  LoopDrive drive_;
  Truth truth_;
  RandomSource odometry_noise_;
  RandomSource sensor_noise_;
  EkfSlam filter_;
  int next_step_ = 0;
};

}  // namespace slamscope::slam
