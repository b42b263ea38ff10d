// SPDX-License-Identifier: MIT
#include "tracking/head_path.hpp"

#include <cmath>
#include <numbers>

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Matrix3d, Eigen::Vector3d;

double secondsAt(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

/// A head at a place that looks at a point, upright.
Isometry3d lookingAt(const Vector3d& place, const Vector3d& target) {
  const Vector3d forward = (target - place).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  Isometry3d T(Eigen::Translation3d{place});
  T.linear() << right, forward.cross(right), forward;
  return T;
}

/// A body never stands still: slow swaying, quicker nodding.
Isometry3d swaying(double t, double amount) {
  const auto wave = [t](double hertz, double phase) {
    return std::sin(2 * std::numbers::pi * hertz * t + phase);
  };
  const Vector3d shift = amount * Vector3d(0.004 * wave(0.31, 0.3) + 0.001 * wave(1.3, 1.1),
                                           0.003 * wave(0.9, 2.0), 0.004 * wave(0.23, 0.7));
  const Vector3d turn = amount * Vector3d(0.004 * wave(0.43, 1.7) + 0.001 * wave(1.7, 0.2),
                                          0.005 * wave(0.37, 0.9), 0.003 * wave(0.29, 2.4));
  Isometry3d T(Eigen::Translation3d{shift});
  T.rotate(Eigen::AngleAxisd(
      turn.norm(), turn.norm() > 0 ? Vector3d(turn.normalized()) : Vector3d(Vector3d::UnitX())));
  return T;
}

/// The head after `walked` metres of its circle, turned aside by `yaw`.
Isometry3d onCircle(const HeadPathOptions& options, double t, double walked, double yaw) {
  const double at = options.start + walked / options.radius;
  const Vector3d place(options.target.x() + options.radius * std::cos(at),
                       options.target.y() + options.radius * std::sin(at), options.height);
  const Isometry3d aside(Eigen::AngleAxisd(yaw, Vector3d::UnitZ()));
  Isometry3d T = lookingAt(place, options.target);
  T.linear() = aside.linear() * T.linear();  // about the vertical, as a neck does
  return T * swaying(t, options.sway);
}

/// To and fro; its greatest rate is turn_rate.
double yawAt(const HeadPathOptions& options, double t) {
  if (options.turn_angle <= 0) return 0;
  return options.turn_angle * std::sin(options.turn_rate / options.turn_angle * t);
}

/// Metres after t of `whole` seconds of a walk that takes a second to start and to stop.
double walkedAt(double speed, double t, double whole) {
  const auto starting = [](double u) { return u < 1 ? u * u * u * (1 - u / 2) : u - 0.5; };
  const double half = whole / 2;
  const double way = t <= half ? starting(t) : 2 * starting(half) - starting(whole - t);
  return speed * way;
}

}  // namespace

HeadPath standingHead(const HeadPathOptions& options) {
  return
      [options](std::chrono::nanoseconds time) { return onCircle(options, secondsAt(time), 0, 0); };
}

HeadPath walkingHead(const HeadPathOptions& options) {
  return [options](std::chrono::nanoseconds time) {
    const double t = secondsAt(time);
    return onCircle(options, t, options.speed * t, 0);
  };
}

HeadPath turningHead(const HeadPathOptions& options) {
  return [options](std::chrono::nanoseconds time) {
    const double t = secondsAt(time);
    return onCircle(options, t, options.speed * t, yawAt(options, t));
  };
}

HeadPath wanderingHead(const HeadPathOptions& options, std::chrono::nanoseconds stand,
                       std::chrono::nanoseconds walk, std::chrono::nanoseconds turn) {
  return [=](std::chrono::nanoseconds time) {
    const double t = secondsAt(time), a = secondsAt(stand), b = secondsAt(walk),
                 c = secondsAt(turn);
    const double round = std::floor(t / (a + b + c)), u = t - round * (a + b + c);
    double walked = round * walkedAt(options.speed, b, b), yaw = 0;
    if (u > a) walked += walkedAt(options.speed, std::min(u - a, b), b);
    if (u > a + b) {
      const double part = (u - a - b) / c;  // comes and goes gently
      yaw = std::pow(std::sin(std::numbers::pi * part), 2) * yawAt(options, u - a - b);
    }
    return onCircle(options, t, walked, yaw);
  };
}

}  // namespace slamscope::tracking
