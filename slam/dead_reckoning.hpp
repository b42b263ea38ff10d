// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstddef>

#include "slam/models.hpp"
#include "slam/recording.hpp"

namespace slamscope::slam {

/// Composes a recording's odometry to motions between any two times, one after the other.
///
/// Noise grows with the root of time, so that the rate of the odometry does not matter; there is
/// none while it says standstill. `sigma` is what a second of driving adds: forward (m), sideways
/// (m), turn (rad); of a car: speed (m/s), sideways (m), steering (rad), where speed and steering
/// are the errors of their means over a second, brought to the motion by the car's Jacobian. A
/// recording without odometry may move anywhere by `sigma` all the time.
class DeadReckoning {
 public:
  /// The recording must outlive this. Throws std::invalid_argument for a car without wheelbase and
  /// for σ that is negative.
  DeadReckoning(const Recording& recording, const Eigen::Vector3d& sigma);

  /// All odometry between two times in one motion: increments composed, their noise by Jacobians.
  /// `from` is the `to` of the call before.
  [[nodiscard]] Motion between(std::chrono::nanoseconds from, std::chrono::nanoseconds to);

  /// (forward m/s, turn rad/s) at the last `to`.
  [[nodiscard]] Eigen::Vector2d velocity() const;

 private:
  [[nodiscard]] Motion part(std::size_t entry, std::chrono::nanoseconds from,
                            std::chrono::nanoseconds to) const;
  [[nodiscard]] Motion driven(const Eigen::Vector3d& motion, double duration) const;
  [[nodiscard]] Motion partOfIncrement(std::size_t entry, std::chrono::nanoseconds from,
                                       std::chrono::nanoseconds to) const;

  const Recording& recording_;
  Eigen::Vector3d variance_;  ///< a second
  std::size_t next_entry_ = 0;
};

/// `first`, then `second`: their increments composed, and the covariance of both by Jacobians.
[[nodiscard]] Motion composed(const Motion& first, const Motion& second);

}  // namespace slamscope::slam
