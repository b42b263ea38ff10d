// SPDX-License-Identifier: MIT
#include "slam/correlation.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace slamscope::slam {

Eigen::Matrix2d relativeCovariance(const Snapshot& snapshot, int i, int j) {
  if (snapshot.diagonal_only) {
    throw std::invalid_argument(
        "relative covariance of two features needs P_ij; only the diagonal of P was logged");
  }
  const int a = Snapshot::row(i);
  const int b = Snapshot::row(j);
  const Eigen::Matrix2d P_ij = snapshot.covariance.block2(a, b);
  return snapshot.covariance.block2(a, a) + snapshot.covariance.block2(b, b) - P_ij -
         P_ij.transpose();  // (13)
}

double ellipseArea(const Eigen::Matrix2d& covariance) {
  const double det = covariance(0, 0) * covariance(1, 1) - covariance(1, 0) * covariance(1, 0);
  return det > 0.0 ? std::sqrt(det) : 0.0;
}

Eigen::Matrix2d PrincipalAxes::directions() const {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return (Eigen::Matrix2d() << c, -s, s, c).finished();
}

PrincipalAxes principalAxes(const Eigen::Matrix2d& covariance) {
  const double mean = 0.5 * (covariance(0, 0) + covariance(1, 1));
  const double half_difference = 0.5 * (covariance(0, 0) - covariance(1, 1));
  const double off = covariance(1, 0);
  const double radius = std::hypot(half_difference, off);
  PrincipalAxes axes;
  const double major = mean + radius;
  double minor = mean - radius;
  if (major > 0.0 && minor < 1e-2 * major) {
    // det / major keeps the digits that the difference cancels.
    minor = (covariance(0, 0) * covariance(1, 1) - off * off) / major;
  }
  if (minor < 0.0 && minor >= -1e-12 * std::abs(major)) minor = 0.0;
  axes.eigenvalues = {major, minor};
  axes.angle = radius > 0.0 ? 0.5 * std::atan2(off, half_difference) : 0.0;
  if (axes.angle <= -std::numbers::pi / 2.0) axes.angle += std::numbers::pi;
  return axes;
}

double AxisScale::semiAxis(double eigenvalue) const {
  if (!(eigenvalue > 0.0)) return 0.0;
  switch (axis) {
    case Axis::eigenvalue:
      return gain * eigenvalue;
    case Axis::sigma:
      return gain * k * std::sqrt(eigenvalue);
    case Axis::log:
      return gain * 0.1 * std::log10(1.0 + k * std::sqrt(eigenvalue) / 1e-3);
  }
  return 0.0;
}

}  // namespace slamscope::slam
