// SPDX-License-Identifier: MIT
#include "tracking/lab_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace slamscope::tracking::lab {
namespace {

/// A round area light.
struct Lamp {
  Eigen::Vector3d p_world;
  double radius;  // m
  float share;    // of the light in the middle of the room
};

const std::array<Lamp, 2> kLamps = {Lamp{{-2.6, 1.9, 2.7}, 0.45, 0.34F},
                                    Lamp{{1.7, 1.1, 3.6}, 0.14F, 0.30F}};
constexpr float kSkyShare = 0.40F;

double smoothStep(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// Part of a lamp that a blocker covers, seen from a point of the floor, 0..1: the blocker as an
/// upright strip, the lamp as a box blurred over its width.
double covered(const Eigen::Vector2d& p, const Lamp& lamp, const Blocker& blocker) {
  const Eigen::Vector2d to_lamp = lamp.p_world.head<2>() - p;
  const double plan = to_lamp.norm();
  const Eigen::Vector2d along = to_lamp / plan, to_blocker = blocker.p_world - p;
  const double ahead = along.dot(to_blocker);
  if (ahead < -blocker.radius) return 0;
  const double aside = std::abs(along.x() * to_blocker.y() - along.y() * to_blocker.x());
  const double ray_height = std::max(0.0, ahead - blocker.radius) * lamp.p_world.z() / plan;
  const double blur = 0.004 + lamp.radius * std::hypot(std::max(ahead, 0.0), ray_height) /
                                  std::hypot(plan, lamp.p_world.z());
  const double left = std::clamp((blocker.radius - aside) / blur, -1.0, 1.0);
  const double right = std::clamp((blocker.radius + aside) / blur, -1.0, 1.0);
  const double below = smoothStep(0.5 + 0.5 * (blocker.height - ray_height) / blur);
  const double begun = smoothStep(1 + ahead / blocker.radius);
  return std::max(0.0, left + right) / 2 * below * begun;
}

}  // namespace

Light openLight(const Eigen::Vector3d& p_world, const Eigen::Vector3d& normal) {
  Light light;
  light[0] = kSkyShare * (0.55F + 0.45F * static_cast<float>(normal.z()));
  for (std::size_t i = 0; i < kLamps.size(); ++i) {
    const Eigen::Vector3d to_lamp = kLamps[i].p_world - p_world;
    const double square = to_lamp.squaredNorm(), middle = kLamps[i].p_world.norm();
    // Cosine over distance squared, as one over the same in the middle of the room.
    const double here = std::max(0.0, normal.dot(to_lamp)) / (square * std::sqrt(square));
    const double there = kLamps[i].p_world.z() / (middle * middle * middle);
    // Half of it comes back from the walls, from everywhere, and the rest falls off more gently
    // than a lone lamp's: no sheet of paper may be so bright that the sensor saturates.
    light[static_cast<int>(i) + 1] =
        kLamps[i].share * static_cast<float>(0.5 + 0.5 * std::sqrt(here / there));
  }
  return light;
}

Light passed(const Eigen::Vector2d& p_world, const Blocker& blocker) {
  const double away = (p_world - blocker.p_world).norm() - blocker.radius;
  Light through;
  through[0] = 1 - 0.5F * static_cast<float>(std::exp(-std::max(away, 0.0) / blocker.contact));
  for (std::size_t i = 0; i < kLamps.size(); ++i)
    through[static_cast<int>(i) + 1] = 1 - static_cast<float>(covered(p_world, kLamps[i], blocker));
  return through;
}

double reach(const Blocker& blocker) {
  return blocker.radius + std::max(8 * blocker.contact, 2.2 * blocker.height);
}

Eigen::Array3f tint(const Light& light) {
  static const Eigen::Array3f sky(1.0F, 1.0F, 1.0F), window(1.10F, 1.01F, 0.92F),
      lamp(0.86F, 0.98F, 1.09F);
  return light[0] * sky + light[1] * window + light[2] * lamp;
}

LightMap::LightMap(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper,
                   const std::vector<Blocker>& blockers)
    : lower_(lower),
      step_(std::max(0.01, (upper - lower).maxCoeff() / 1500)),
      columns_(static_cast<int>((upper - lower).x() / step_) + 2),
      rows_(static_cast<int>((upper - lower).y() / step_) + 2),
      cells_(static_cast<std::size_t>(columns_) * rows_) {
  const auto place = [&](int column, int row) -> Eigen::Vector2d {
    return lower_ + step_ * Eigen::Vector2d(column, row);
  };
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const Eigen::Vector2d p = place(column, row);
      cells_[static_cast<std::size_t>(row) * columns_ + column] =
          openLight({p.x(), p.y(), 0}, Eigen::Vector3d::UnitZ());
    }
  for (const Blocker& blocker : blockers) {
    const Eigen::Vector2d cell = (blocker.p_world - lower_) / step_;
    const int span = static_cast<int>(std::ceil(reach(blocker) / step_));
    const int column = static_cast<int>(cell.x()), row = static_cast<int>(cell.y());
    for (int r = std::max(0, row - span); r < std::min(rows_, row + span + 1); ++r)
      for (int c = std::max(0, column - span); c < std::min(columns_, column + span + 1); ++c)
        cells_[static_cast<std::size_t>(r) * columns_ + c] *= passed(place(c, r), blocker);
  }
}

Light LightMap::at(const Eigen::Vector2d& p_world) const {
  const Eigen::Vector2d cell = (p_world - lower_) / step_;
  const double x = std::clamp(cell.x(), 0.0, columns_ - 1.001);
  const double y = std::clamp(cell.y(), 0.0, rows_ - 1.001);
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const auto fx = static_cast<float>(x - column), fy = static_cast<float>(y - row);
  const Light* a = &cells_[static_cast<std::size_t>(row) * columns_ + column];
  const Light* b = a + columns_;
  return (1 - fy) * ((1 - fx) * a[0] + fx * a[1]) + fy * ((1 - fx) * b[0] + fx * b[1]);
}

}  // namespace slamscope::tracking::lab
