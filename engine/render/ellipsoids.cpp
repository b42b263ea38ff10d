// SPDX-License-Identifier: MIT
#include "engine/render/ellipsoids.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "engine/render/shader_code.hpp"

namespace slamscope::engine {

namespace {

constexpr std::uint32_t kWhole = 0;  // as in ellipsoids.frag

bool orthogonal(const Eigen::Matrix3d& axes) {
  const Eigen::Matrix3d gram = axes.transpose() * axes;
  const double off = std::abs(gram(0, 1)) + std::abs(gram(0, 2)) + std::abs(gram(1, 2));
  return off <= 1e-12 * gram.trace();
}

struct Keyed {
  long long distance = 0;  // of the centre, in units of 0.1 µm: rounding must not decide the order
  double size = 0.0;
  interop::EllipsoidGlyph glyph;
  std::uint64_t tag = 0;
};

/// Farther first; of concentric ones the inner first, as the outer lies over it. The rest only
/// makes the order the same whatever the order given.
bool drawnBefore(const Keyed& a, const Keyed& b) {
  if (a.distance != b.distance) return a.distance > b.distance;
  if (a.size != b.size) return a.size < b.size;
  return std::memcmp(&a.glyph, &b.glyph, sizeof(a.glyph)) < 0;
}

}  // namespace

Eigen::Matrix3d drawableAxes(const Eigen::Matrix3d& axes, double distance) {
  Eigen::Matrix3d directions;
  Eigen::Vector3d lengths = axes.colwise().norm();
  const bool usable = lengths.minCoeff() > 1e-4 * lengths.maxCoeff() && orthogonal(axes);
  if (usable) {
    directions = axes * lengths.cwiseInverse().asDiagonal();
  } else {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(axes * axes.transpose());
    directions = eigen.eigenvectors();
    lengths = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  }
  const double least = std::max(1e-4 * lengths.maxCoeff(), 1e-6 * distance + 1e-12);
  return directions * lengths.cwiseMax(least).asDiagonal();
}

EllipsoidPass::EllipsoidPass(const PassSetup& setup)
    : instances_(setup.core),
      looks_(setup.core,
             {.vertex = shaderCode("ellipsoids_vert"),
              .fragment = shaderCode("ellipsoids_frag"),
              .sets = {setup.frame_layout, instances_.set().layout()},
              .view_mask = setup.view_mask,
              .depth_test = true,
              .depth_write = true},
             kWhole, Picked::Kind::ellipsoid) {}

void EllipsoidPass::update(std::span<const Ellipsoid> ellipsoids, const ViewSet& views,
                           int& not_drawn) {
  std::vector<Keyed> keyed;
  keyed.reserve(ellipsoids.size());
  for (const Ellipsoid& ellipsoid : ellipsoids) {
    if (!ellipsoid.centre.allFinite() || !ellipsoid.axes.allFinite()) {
      ++not_drawn;
      continue;
    }
    const double distance = (views.T_shared_scene() * ellipsoid.centre).norm();
    const Eigen::Matrix3d axes = drawableAxes(ellipsoid.axes, distance);
    keyed.push_back({.distance = std::llround(distance * 1e7),
                     .size = axes.squaredNorm(),
                     .glyph = {.centre = views.point(ellipsoid.centre),
                               .axis0 = views.direction(axes.col(0)),
                               .axis1 = views.direction(axes.col(1)),
                               .axis2 = views.direction(axes.col(2)),
                               .colour = views.colour(ellipsoid.colour)},
                     .tag = ellipsoid.tag});
  }
  std::ranges::sort(keyed, drawnBefore);
  sorted_.clear();
  tags_.clear();
  for (const Keyed& each : keyed) {
    sorted_.push_back(each.glyph);
    tags_.push_back(each.tag);
  }
  instances_.upload<interop::EllipsoidGlyph>(sorted_);
}

void EllipsoidPass::record(const FrameContext& context) const {
  context.draw("ellipsoids", looks_[context.look], instances_.set().handle(), 4,
               instances_.count());
}

}  // namespace slamscope::engine
