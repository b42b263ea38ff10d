// SPDX-License-Identifier: MIT
#include "engine/scene/pair_ellipsoid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slamscope::engine {
namespace {

double semiAxis(const AxisLaw& law, double eigenvalue) {
  const double sigma = std::sqrt(std::max(eigenvalue, 0.0));
  switch (law.kind) {
    case AxisLaw::Kind::root:
      return law.gain * sigma;
    case AxisLaw::Kind::linear:
      return law.gain * sigma * sigma;
    case AxisLaw::Kind::logarithmic:
      return law.gain * std::log1p(sigma / law.unit) / std::numbers::ln10;
  }
  return 0.0;
}

}  // namespace

Eigen::Matrix2d differenceCovariance(const PlanarPoints& points, std::uint32_t i, std::uint32_t j) {
  const auto block = [&points](std::size_t row, std::size_t column) {
    const Eigen::Vector4d b = points.blocks()[row * (row + 1) / 2 + column].cast<double>();
    return (Eigen::Matrix2d() << b(0), b(1), b(2), b(3)).finished();
  };
  const Eigen::Matrix2d P_ji = block(std::max(i, j), std::min(i, j));
  return block(i, i) + block(j, j) - P_ji - P_ji.transpose();
}

Ellipsoid pairEllipsoid(const PairGlyphs& glyphs, std::uint32_t i, std::uint32_t j) {
  const Eigen::Matrix2d P = differenceCovariance(*glyphs.points, i, j);
  const Eigen::Vector2d h(0.5 * (P(0, 0) - P(1, 1)), P(1, 0));
  const double mean = 0.5 * P.trace();
  const double major = mean + h.norm();
  const double minor = major > 0.0 ? P.determinant() / major : 0.0;
  const double angle = 0.5 * std::atan2(h.y(), h.x());
  const auto means = glyphs.points->means();
  const Eigen::Vector2d middle =
      glyphs.scale * (glyphs.points->origin() + 0.5 * (means[i] + means[j]).cast<double>());
  Ellipsoid ellipsoid{.centre = {middle.x(), middle.y(), 0.0},
                      .axes = Eigen::Matrix3d::Zero(),
                      .colour = glyphs.colour};
  const double least = semiAxis(glyphs.axis, minor);
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
  ellipsoid.axes.col(0).head<2>() = semiAxis(glyphs.axis, major) * along;
  ellipsoid.axes.col(1).head<2>() = least * Eigen::Vector2d(-along.y(), along.x());
  ellipsoid.axes(2, 2) = least;
  return ellipsoid;
}

}  // namespace slamscope::engine
