// SPDX-License-Identifier: MIT
#include "tracking/lab_shapes.hpp"

#include <cmath>
#include <numbers>

namespace slamscope::tracking::lab {
namespace {

/// The part of a ray inside a convex solid, cut down half-space by half-space.
struct Span {
  double enter = -std::numeric_limits<double>::infinity();
  double leave = std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // of the face that is entered

  /// Keeps where offset + t slope ≤ 0; false when nothing is left.
  bool cut(double offset, double slope, const Eigen::Vector3d& outward) {
    if (slope == 0) return offset <= 0;
    const double t = -offset / slope;
    if (slope > 0) {
      leave = std::min(leave, t);
    } else if (t > enter) {
      enter = t;
      normal = outward;
    }
    return enter < leave;
  }

  [[nodiscard]] Hit hit() const {
    return enter > 0 && enter < leave ? Hit{.t = enter, .normal = normal} : Hit{};
  }
};

}  // namespace

Prism makeBox(const Eigen::Vector2d& centre, const Eigen::Vector2d& half, double bottom, double top,
              double yaw, double chamfer) {
  Prism prism{.sides = {}, .bottom = bottom, .top = top};
  const auto add_side = [&](double angle, double reach) {
    const Eigen::Vector2d n(std::cos(yaw + angle), std::sin(yaw + angle));
    prism.sides.emplace_back(n.x(), n.y(), n.dot(centre) + reach);
  };
  constexpr double kQuarter = std::numbers::pi / 2;
  for (int i = 0; i < 4; ++i) add_side(i * kQuarter, i % 2 == 0 ? half.x() : half.y());
  if (chamfer > 0) {
    const double reach = (half.sum() - chamfer) / std::numbers::sqrt2;
    for (int i = 0; i < 4; ++i) add_side((i + 0.5) * kQuarter, reach);
  }
  return prism;
}

Hit intersect(const Ray& ray, const Cylinder& cylinder) {
  const int along = cylinder.axis, u = (along + 1) % 3, v = (along + 2) % 3;
  const Eigen::Vector3d o = ray.origin - cylinder.centre;
  const Eigen::Vector3d& d = ray.direction;
  const double a = d[u] * d[u] + d[v] * d[v];
  const double b = o[u] * d[u] + o[v] * d[v];
  const double c = o[u] * o[u] + o[v] * o[v] - cylinder.radius * cylinder.radius;
  Span span;
  if (a > 0) {
    const double discriminant = b * b - a * c;
    if (discriminant <= 0) return {};
    const double root = std::sqrt(discriminant);
    span.enter = (-b - root) / a;
    span.leave = (-b + root) / a;
    span.normal.setZero();
    span.normal[u] = (o[u] + span.enter * d[u]) / cylinder.radius;
    span.normal[v] = (o[v] + span.enter * d[v]) / cylinder.radius;
  } else if (c > 0) {
    return {};
  }
  const Eigen::Vector3d end = Eigen::Vector3d::Unit(along);
  if (!span.cut(o[along] - cylinder.half_length, d[along], end)) return {};
  if (!span.cut(-o[along] - cylinder.half_length, -d[along], -end)) return {};
  return span.hit();
}

Hit intersect(const Ray& ray, const Prism& prism) {
  Span span;
  const Eigen::Vector3d &o = ray.origin, &d = ray.direction;
  if (!span.cut(o.z() - prism.top, d.z(), Eigen::Vector3d::UnitZ())) return {};
  if (!span.cut(prism.bottom - o.z(), -d.z(), -Eigen::Vector3d::UnitZ())) return {};
  for (const Eigen::Vector3d& side : prism.sides) {
    const double offset = side.x() * o.x() + side.y() * o.y() - side.z();
    const double slope = side.x() * d.x() + side.y() * d.y();
    if (!span.cut(offset, slope, {side.x(), side.y(), 0})) return {};
  }
  return span.hit();
}

}  // namespace slamscope::tracking::lab
