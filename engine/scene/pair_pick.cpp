// SPDX-License-Identifier: MIT
#include "engine/scene/pair_pick.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <vector>

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

/// Which pairs are drawn, by all conditions.
class ChosenPairs {
 public:
  explicit ChosenPairs(const PairGlyphs& glyphs) : points_(*glyphs.points), choice_(glyphs.choice) {
    for (const auto& [a, b] : choice_.left_out) left_out_.insert(std::minmax(a, b));
    if (choice_.most > 0) least_area_ = areaOfTheMost();
  }

  [[nodiscard]] bool operator()(std::uint32_t i, std::uint32_t j) const {
    return wanted(i, j) && area(i, j) >= std::max(choice_.least_area, least_area_);
  }

 private:
  [[nodiscard]] bool wanted(std::uint32_t i, std::uint32_t j) const {
    const auto touches = [this](std::uint32_t k) {
      return std::ranges::find(choice_.touching, k) != choice_.touching.end();
    };
    return (choice_.groups.empty() || choice_.groups[i] != choice_.groups[j]) &&
           (choice_.touching.empty() || touches(i) || touches(j)) && !left_out_.contains({i, j});
  }

  [[nodiscard]] double area(std::uint32_t i, std::uint32_t j) const {
    return std::sqrt(std::max(differenceCovariance(points_, i, j).determinant(), 0.0));
  }

  [[nodiscard]] double areaOfTheMost() const {
    std::vector<double> areas;
    const auto count = static_cast<std::uint32_t>(points_.count());
    for (std::uint32_t j = 1; j < count; ++j) {
      for (std::uint32_t i = 0; i < j; ++i) {
        if (wanted(i, j)) areas.push_back(area(i, j));
      }
    }
    if (areas.size() <= choice_.most) return 0.0;
    const auto last = areas.begin() + (choice_.most - 1);
    std::nth_element(areas.begin(), last, areas.end(), std::greater<>());
    return *last;
  }

  const PlanarPoints& points_;
  const PairChoice& choice_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> left_out_;
  double least_area_ = 0.0;
};

/// Depth at which a ray from the eye (z = 1) first meets an ellipsoid with orthogonal axes; none
/// where the eye is inside of it or it is behind.
std::optional<double> depthOfHit(const Ellipsoid& ellipsoid, const Eigen::Isometry3d& T_eye_scene,
                                 const Eigen::Vector3d& ray) {
  const Eigen::Vector3d mu = T_eye_scene * ellipsoid.centre;
  const Eigen::Matrix3d axes = T_eye_scene.linear() * ellipsoid.axes;
  const Eigen::Vector3d inverse_squares = axes.colwise().squaredNorm().cwiseInverse();
  const Eigen::Vector3d d = inverse_squares.cwiseProduct(axes.transpose() * ray);
  const Eigen::Vector3d o = inverse_squares.cwiseProduct(axes.transpose() * mu);
  const double b = d.dot(o);
  const double c = o.squaredNorm() - 1.0;
  const double discriminant = b * b - d.squaredNorm() * c;
  if (!(discriminant >= 0.0) || !(b > 0.0) || !(c > 0.0)) return std::nullopt;
  return c / (b + std::sqrt(discriminant));
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

std::optional<PickedPair> pickPair(const PairGlyphs& glyphs, const View& view,
                                   const Eigen::Vector2d& pixel) {
  if (!glyphs.points) return std::nullopt;
  const Pinhole& camera = view.camera;
  const double y = (pixel.y() - camera.cy) / camera.fy;
  const Eigen::Vector3d ray((pixel.x() - camera.cx - camera.skew * y) / camera.fx, y, 1.0);
  const ChosenPairs chosen(glyphs);
  std::optional<PickedPair> nearest;
  const auto count = static_cast<std::uint32_t>(glyphs.points->count());
  for (std::uint32_t j = 1; j < count; ++j) {
    for (std::uint32_t i = 0; i < j; ++i) {
      const auto depth = depthOfHit(pairEllipsoid(glyphs, i, j), view.T_eye_scene, ray);
      if (!depth || (nearest && *depth >= nearest->depth) || !chosen(i, j)) continue;
      nearest = PickedPair{.i = i, .j = j, .depth = *depth};
    }
  }
  return nearest;
}

}  // namespace slamscope::engine
