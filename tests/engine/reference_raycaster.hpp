// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "engine/scene/glyphs.hpp"
#include "engine/scene/view.hpp"

// What a picture must show, computed ray by ray in double precision, with nothing shared with the
// shaders: the oracle of the picture tests.
namespace slamscope::engine::reference {

/// Nothing (-1) or the index of the solid hit first: ellipsoids first, then cones.
struct Hit {
  int id = -1;
  double depth = std::numeric_limits<double>::infinity();  ///< z in the eye, m
};

struct Picture {
  int width = 0, height = 0;
  std::vector<Hit> hits;
  [[nodiscard]] const Hit& at(int u, int v) const { return hits[v * width + u]; }
};

/// A ray from the eye: p(z) = origin + z · direction in the scene, so that its parameter is depth.
struct Ray {
  Eigen::Vector3d origin, direction;
  [[nodiscard]] Eigen::Vector3d at(double z) const { return origin + z * direction; }
};

inline Ray rayThrough(const View& view, double u, double v) {
  const Pinhole& camera = view.camera;
  const double y = (v - camera.cy) / camera.fy;
  const double x = (u - camera.cx - camera.skew * y) / camera.fx;
  const Eigen::Isometry3d T_scene_eye = view.T_eye_scene.inverse();
  return {T_scene_eye.translation(), T_scene_eye.linear() * Eigen::Vector3d(x, y, 1.0)};
}

/// Both real roots of a z² + 2 b z + c, the smaller first.
inline std::optional<std::pair<double, double>> roots(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0 || a == 0.0) return std::nullopt;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  const double first = q / a;
  const double second = q != 0.0 ? c / q : first;
  return std::pair{std::min(first, second), std::max(first, second)};
}

/// Depth of the first point of the ellipsoid in front of the eye; `inverse` is that of its axes.
inline std::optional<double> hitDepth(const Eigen::Vector3d& centre, const Eigen::Matrix3d& inverse,
                                      const Ray& ray) {
  // In coordinates in which the ellipsoid is the unit ball.
  const Eigen::Vector3d o = inverse * (ray.origin - centre);
  const Eigen::Vector3d d = inverse * ray.direction;
  const auto z = roots(d.squaredNorm(), o.dot(d), o.squaredNorm() - 1.0);
  if (!z || z->second <= 0.0) return std::nullopt;
  return z->first > 0.0 ? z->first : z->second;
}

/// Depth of the first point of the cone (side or lid) in front of the eye.
inline std::optional<double> hitDepth(const Cone& cone, const Ray& ray) {
  std::optional<double> nearest;
  const auto offer = [&nearest](double z) {
    if (z > 0.0 && (!nearest || z < *nearest)) nearest = z;
  };
  const double slope2 = (cone.radius / cone.height) * (cone.radius / cone.height);
  const Eigen::Vector3d metric(1.0, 1.0, -slope2);  // x² + y² − slope² z² = 0, tip at the origin
  const Eigen::Vector3d o = ray.origin - cone.tip;
  const Eigen::Vector3d& d = ray.direction;
  const auto dot = [&metric](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return a.cwiseProduct(metric).dot(b);
  };
  if (const auto z = roots(dot(d, d), dot(o, d), dot(o, o))) {
    for (const double side : {z->first, z->second}) {
      const double up = o.z() + side * d.z();
      if (up >= 0.0 && up <= cone.height) offer(side);
    }
  }
  if (d.z() != 0.0) {
    const double lid = (cone.height - o.z()) / d.z();
    if ((o + lid * d).head<2>().norm() <= cone.radius) offer(lid);
  }
  return nearest;
}

/// The first hit through every pixel centre.
inline Picture raycast(const Scene& scene, const View& view) {
  Picture picture{view.camera.width, view.camera.height, {}};
  picture.hits.resize(static_cast<std::size_t>(picture.width) * picture.height);
  const auto offer = [](Hit& hit, int id, std::optional<double> depth) {
    if (depth && *depth < hit.depth) hit = {id, *depth};
  };
  std::vector<Eigen::Matrix3d> inverses;
  for (const Ellipsoid& e : scene.ellipsoids) inverses.push_back(e.axes.inverse());
  for (int v = 0; v < picture.height; ++v) {
    for (int u = 0; u < picture.width; ++u) {
      const Ray ray = rayThrough(view, u, v);
      Hit& hit = picture.hits[v * picture.width + u];
      int id = 0;
      for (std::size_t i = 0; i < inverses.size(); ++i) {
        offer(hit, id++, hitDepth(scene.ellipsoids[i].centre, inverses[i], ray));
      }
      for (const Cone& c : scene.cones) offer(hit, id++, hitDepth(c, ray));
    }
  }
  return picture;
}

/// The hits of a picture, and what lies between its pixel centres: kFine rays a pixel each way (the
/// middle one through the centre), and kMargin pixels past its edges. So borders are known that no
/// pixel centre sees.
class FinePicture {
 public:
  static constexpr int kFine = 3;
  static constexpr int kMargin = 2;

  FinePicture(const Scene& scene, const View& view) : picture_(raycast(scene, finer(view))) {}

  [[nodiscard]] const Hit& at(int u, int v) const { return picture_.at(middle(u), middle(v)); }

  /// True where a border between two ids is within 1 pixel of the pixel's centre (a little more):
  /// there anti-aliasing may mix.
  [[nodiscard]] bool nearEdge(int u, int v) const {
    constexpr int kReach = kFine + 1;
    for (int y = middle(v) - kReach; y <= middle(v) + kReach; ++y) {
      for (int x = middle(u) - kReach; x <= middle(u) + kReach; ++x) {
        if (picture_.at(x, y).id != at(u, v).id) return true;
      }
    }
    return false;
  }

 private:
  static int middle(int pixel) { return kFine * (pixel + kMargin) + kFine / 2; }

  static View finer(View view) {
    Pinhole& camera = view.camera;
    camera.width = kFine * (camera.width + 2 * kMargin);
    camera.height = kFine * (camera.height + 2 * kMargin);
    camera.fx *= kFine;
    camera.fy *= kFine;
    camera.skew *= kFine;
    camera.cx = kFine * (camera.cx + kMargin) + kFine / 2;
    camera.cy = kFine * (camera.cy + kMargin) + kFine / 2;
    return view;
  }

  Picture picture_;
};

}  // namespace slamscope::engine::reference
