// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <vector>

namespace slamscope::tracking::lab {

/// p = origin + t direction, t > 0; the direction has any length.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();

  [[nodiscard]] Eigen::Vector3d at(double t) const { return origin + t * direction; }
};

[[nodiscard]] inline Ray operator*(const Eigen::Isometry3d& T_a_b, const Ray& ray_b) {
  return {T_a_b * ray_b.origin, T_a_b.linear() * ray_b.direction};
}

/// Where a ray enters a solid.
struct Hit {
  double t = std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward, unit

  explicit operator bool() const { return t < std::numeric_limits<double>::infinity(); }
};

/// A ball around something: most rays miss it, and are done with.
struct Ball {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;

  /// Whether a ray may hit it that is turned by up to `spread` (rad, small) from this one.
  [[nodiscard]] bool mayBeHit(const Ray& ray, double spread = 0) const {
    const Eigen::Vector3d to_centre = centre - ray.origin;
    const double wide = radius + (spread > 0 ? spread * to_centre.norm() : 0);
    return to_centre.cross(ray.direction).squaredNorm() <=
           wide * wide * ray.direction.squaredNorm();
  }
};

/// Solid cylinder along one of the coordinate axes (0 x, 1 y, 2 z).
struct Cylinder {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0, half_length = 0;
  int axis = 2;
};

/// Upright solid over a convex polygon: all p with side.xy · p.xy ≤ side.z for each side, and
/// bottom ≤ z ≤ top. The sides' normals (x, y) are units.
struct Prism {
  std::vector<Eigen::Vector3d> sides;
  double bottom = 0, top = 0;
};

/// A box of half sizes (x, y) turned by `yaw`, its corners cut off by `chamfer` along each side.
[[nodiscard]] Prism makeBox(const Eigen::Vector2d& centre, const Eigen::Vector2d& half,
                            double bottom, double top, double yaw = 0, double chamfer = 0);

/// First hit in front of the ray's origin; an origin inside the solid sees nothing.
[[nodiscard]] Hit intersect(const Ray& ray, const Cylinder& cylinder);
[[nodiscard]] Hit intersect(const Ray& ray, const Prism& prism);

}  // namespace slamscope::tracking::lab
