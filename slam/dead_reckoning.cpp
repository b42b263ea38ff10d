// SPDX-License-Identifier: MIT
#include "slam/dead_reckoning.hpp"

#include <algorithm>
#include <stdexcept>

namespace slamscope::slam {

using std::chrono::nanoseconds;

Motion composed(const Motion& first, const Motion& second) {
  Motion both;
  Eigen::Matrix3d F_x;
  Eigen::Matrix3d G_u;
  both.increment = movePose(first.increment, second.increment, &F_x, &G_u);
  both.M = F_x * first.M * F_x.transpose() + G_u * second.M * G_u.transpose();
  return both;
}

DeadReckoning::DeadReckoning(const Recording& recording, const Eigen::Vector3d& sigma)
    : recording_(recording), variance_(sigma.cwiseAbs2()) {
  if (!(sigma.minCoeff() >= 0.0)) {
    throw std::invalid_argument("the σ of odometry must not be negative");
  }
  if (recording.odometry_kind == Recording::Odometry::ackermann &&
      !(recording.vehicle.wheelbase > 0.0)) {
    throw std::invalid_argument(recording.name +
                                ": odometry is speed and steering, so a wheelbase is needed");
  }
}

/// The interval of entry k goes from its time to that of entry k + 1.
Motion DeadReckoning::between(nanoseconds from, nanoseconds to) {
  const auto& entries = recording_.odometry;
  Motion total;
  if (entries.empty()) {
    total.M = Eigen::Vector3d(seconds(to - from) * variance_).asDiagonal();
  }
  for (; next_entry_ + 1 < entries.size() && entries[next_entry_].time <= to; ++next_entry_) {
    const nanoseconds begin = std::max(from, entries[next_entry_].time);
    const nanoseconds end = std::min(to, entries[next_entry_ + 1].time);
    total = composed(total, part(next_entry_, begin, end));
    if (entries[next_entry_ + 1].time > to) break;
  }
  total.control = total.increment;
  return total;
}

Eigen::Vector2d DeadReckoning::velocity() const {
  const auto& entries = recording_.odometry;
  if (entries.size() < 2) return Eigen::Vector2d::Zero();
  const std::size_t entry = std::min(next_entry_, entries.size() - 2);
  const Eigen::Vector3d& motion = entries[entry].motion;
  switch (recording_.odometry_kind) {
    case Recording::Odometry::velocity:
      return {motion[0], motion[2]};
    case Recording::Odometry::ackermann:
      return ackermannVelocity(recording_.vehicle, {motion[0], motion[2]});
    case Recording::Odometry::increment:
      break;
  }
  const double duration = seconds(entries[entry + 1].time - entries[entry].time);
  if (!(duration > 0.0)) return Eigen::Vector2d::Zero();
  const Eigen::Vector3d& moved = entries[entry + 1].motion;
  return Eigen::Vector2d(moved[0], moved[2]) / duration;
}

/// What entry number `entry` moved the robot between two times, and how surely.
Motion DeadReckoning::part(std::size_t entry, nanoseconds from, nanoseconds to) const {
  if (recording_.odometry_kind == Recording::Odometry::increment) {
    return partOfIncrement(entry, from, to);
  }
  return driven(recording_.odometry[entry].motion, seconds(to - from));
}

Motion DeadReckoning::driven(const Eigen::Vector3d& motion, double duration) const {
  const Eigen::Vector2d control(motion[0], motion[2]);
  Motion result;
  if (recording_.odometry_kind == Recording::Odometry::velocity) {
    result.increment = arcIncrement(control, duration);
    if (!result.increment.isZero(0.0)) {
      result.M = Eigen::Vector3d(duration * variance_).asDiagonal();
    }
    return result;
  }
  Eigen::Matrix2d J;
  Matrix32d G_u;
  const Eigen::Vector2d velocity = ackermannVelocity(recording_.vehicle, control, &J);
  result.increment = arcIncrement(velocity, duration, &G_u);
  if (result.increment.isZero(0.0)) return result;
  // White noise of the controls: the variance of a mean over `duration` is σ² / duration.
  const Matrix32d G = G_u * J;
  const Eigen::Vector2d controls = Eigen::Vector2d(variance_[0], variance_[2]) / duration;
  result.M = G * controls.asDiagonal() * G.transpose();
  result.M(1, 1) += duration * variance_[1];
  return result;
}

Motion DeadReckoning::partOfIncrement(std::size_t entry, nanoseconds from, nanoseconds to) const {
  const OdometryEntry& next = recording_.odometry[entry + 1];
  const nanoseconds begin = recording_.odometry[entry].time;
  const double length = seconds(next.time - begin);
  const double share = length == 0.0 ? 1.0 : seconds(to - from) / length;
  Motion result;
  result.increment = length == 0.0 ? next.motion
                                   : incrementBetween(seconds(from - begin) / length * next.motion,
                                                      seconds(to - begin) / length * next.motion);
  if (next.M) {
    result.M = share * *next.M;
  } else if (!result.increment.isZero(0.0)) {
    result.M = Eigen::Vector3d(seconds(to - from) * variance_).asDiagonal();
  }
  return result;
}

}  // namespace slamscope::slam
