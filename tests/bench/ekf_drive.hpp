// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "slam/ekf_equations.hpp"
#include "slam/simulation_random.hpp"

namespace slamscope::slam::bench {

inline constexpr int kObservations = 10;
inline constexpr int kSteps = 64;  ///< of a circle, driven again and again

inline const Eigen::Matrix2d kM = Eigen::Vector2d(0.0009, 0.0036).asDiagonal();
inline const Eigen::Matrix2d kR = Eigen::Vector2d(0.0036, 0.0016).asDiagonal();

/// A circle among features on a wider ring, with the readings of each step.
struct Drive {
  std::vector<Observation> first;  ///< one reading of every feature, from the start
  Motion motion;
  std::vector<std::vector<Observation>> readings;

  explicit Drive(int count) {
    RandomSource random(1);
    std::vector<Eigen::Vector2d> features;
    for (int k = 0; k < count; ++k) {
      const double angle = random.uniform(-3.1, 3.1);
      const double radius = random.uniform(2.0, 5.0);
      features.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    const auto read = [&](const Eigen::Vector3d& pose, std::size_t k) {
      Eigen::Vector2d z = observeFeature(Sensor::range_bearing, pose, features[k]);
      z += Eigen::Vector2d(0.06 * random.normal(), 0.04 * random.normal());
      return Observation{k, z, kR};
    };
    Eigen::Vector3d pose = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < features.size(); ++k) first.push_back(read(pose, k));
    const double turn = 2.0 * std::numbers::pi / (kSteps * 0.1);
    motion = Motion::fromVelocity(0.25, turn, 0.1, kM);
    for (int step = 0; step < kSteps; ++step) {
      pose = movePose(pose, motion.increment);
      std::vector<Observation>& now = readings.emplace_back();
      for (int k = 0; k < kObservations; ++k) {
        now.push_back(read(pose, static_cast<std::size_t>((step * 7 + k) % count)));
      }
    }
  }
};

}  // namespace slamscope::slam::bench
