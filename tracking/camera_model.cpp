// SPDX-License-Identifier: MIT
#include "tracking/camera_model.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace slamscope::tracking {
namespace {

using Eigen::Matrix2d, Eigen::Vector2d, Eigen::Vector3d;

constexpr double kRightAngle = std::numbers::pi / 2;

/// Radial factor of plumb_bob and rational_polynomial (OpenCV, "Camera Calibration and 3D
/// Reconstruction") over s = r², and its derivative by s.
struct Radial {
  double value, slope;
};

Radial radial(const std::vector<double>& D, double s) {
  const double n = 1 + s * (D[0] + s * (D[1] + s * D[4]));
  const double dn = D[0] + s * (2 * D[1] + s * 3 * D[4]);
  const double d = 1 + s * (D[5] + s * (D[6] + s * D[7]));
  const double dd = D[5] + s * (2 * D[6] + s * 3 * D[7]);
  if (d <= 0) return {-1, -1};  // past the pole: not valid
  return {n / d, (dn - n * dd / d) / d};
}

/// θ_d of the equidistant model and its derivative by θ.
Radial equidistant(const std::vector<double>& D, double theta) {
  const double s = theta * theta;
  return {theta * (1 + s * (D[0] + s * (D[1] + s * (D[2] + s * D[3])))),
          1 + s * (3 * D[0] + s * (5 * D[1] + s * (7 * D[2] + s * 9 * D[3])))};
}

/// Distorted radius and its derivative, by r = tan θ, or by θ for the equidistant model.
Radial distortedRadius(const CameraInfo& info, const std::vector<double>& D, double r) {
  if (info.model == DistortionModel::equidistant) return equidistant(D, r);
  const Radial f = radial(D, r * r);
  return {r * f.value, f.value + 2 * r * r * f.slope};
}

/// First angle at which the distorted radius stops growing.
double firstFold(const CameraInfo& info, const std::vector<double>& D) {
  const bool fisheye = info.model == DistortionModel::equidistant;
  const double end = fisheye ? std::numbers::pi : kRightAngle;
  const auto grows = [&](double angle) {
    return distortedRadius(info, D, fisheye ? angle : std::tan(angle)).slope > 0;
  };
  constexpr int kSteps = 4096;
  for (int i = 1; i < kSteps; ++i) {
    if (grows(end * i / kSteps)) continue;
    double inside = end * (i - 1) / kSteps, outside = end * i / kSteps;
    for (int k = 0; k < 60; ++k) {
      const double middle = (inside + outside) / 2;
      (grows(middle) ? inside : outside) = middle;
    }
    return inside;
  }
  return end;
}

/// r in [0, limit] whose distorted radius is `target`; `limit` where it would lie beyond. Newton's
/// steps within a bracket, as the function is known to grow.
double undistortedRadius(const CameraInfo& info, const std::vector<double>& D, double target,
                         double limit) {
  double low = 0, high = limit;
  double r = std::min(target, limit);
  for (int i = 0; i < 100; ++i) {
    const Radial f = distortedRadius(info, D, r);
    if (std::abs(f.value - target) < 1e-15 * (1 + target)) break;
    (f.value < target ? low : high) = r;
    double next = r - (f.value - target) / f.slope;
    if (!(next > low && next < high)) {
      next = std::isfinite(high) ? (low + high) / 2 : 2 * r + 1;
    }
    if (next == r) break;
    r = next;
  }
  return r;
}

/// Distortion of a point of the plane z = 1, with its derivative.
Vector2d distort(const std::vector<double>& D, const Vector2d& p, Matrix2d* J = nullptr) {
  const double x = p.x(), y = p.y(), s = p.squaredNorm();
  const Radial f = radial(D, s);
  const double p1 = D[2], p2 = D[3];
  if (J) {
    *J << f.value + 2 * x * x * f.slope + 2 * p1 * y + 6 * p2 * x,
        2 * x * y * f.slope + 2 * p1 * x + 2 * p2 * y,  //
        2 * x * y * f.slope + 2 * p1 * x + 2 * p2 * y,
        f.value + 2 * y * y * f.slope + 6 * p1 * y + 2 * p2 * x;
  }
  return {x * f.value + 2 * p1 * x * y + p2 * (s + 2 * x * x),
          y * f.value + p1 * (s + 2 * y * y) + 2 * p2 * x * y};
}

/// g = θ_d / ρ, the factor from (X, Y) to the distorted plane, and its derivatives by ρ and Z.
struct FisheyeFactor {
  double value, by_rho, by_z;
};

FisheyeFactor fisheyeFactor(const std::vector<double>& D, double rho, double z) {
  const double n = rho * rho + z * z;
  const Radial f = equidistant(D, std::atan2(rho, z));
  if (z > 0 && rho < 1e-5 * z) {  // series about the axis: the quotients below cancel there
    const double c = (D[0] - 1.0 / 3) / (z * z * z);
    return {1 / z + c * rho * rho, 2 * c * rho, -f.slope / n};
  }
  return {f.value / rho, (f.slope * z / n - f.value / rho) / rho, -f.slope / n};
}

}  // namespace

CameraModel::CameraModel(CameraInfo info) : info_(std::move(info)), D_(info_.D) {
  const Eigen::Matrix3d& K = info_.K;
  std::ostringstream problem;
  if (info_.width <= 0 || info_.height <= 0) {
    problem << "camera " << info_.name << ": size " << info_.width << " x " << info_.height;
  } else if (!(K(0, 0) > 0 && K(1, 1) > 0 && K(1, 0) == 0 && K(2, 0) == 0 && K(2, 1) == 0 &&
               K(2, 2) == 1)) {
    problem << "camera " << info_.name << ": K is no camera matrix:\n" << K;
  }
  const bool fisheye = info_.model == DistortionModel::equidistant;
  const bool rational = info_.model == DistortionModel::rational_polynomial;
  const std::size_t n = D_.size();
  if (n != 0 && (fisheye ? n != 4 : rational ? n != 8 : n != 4 && n != 5)) {
    problem << "camera " << info_.name << ": " << n << " distortion coefficients";
  }
  if (!problem.str().empty()) throw std::invalid_argument(problem.str());

  undistorted_ = !fisheye;
  for (const double d : D_) undistorted_ = undistorted_ && d == 0;
  D_.resize(fisheye ? 4 : 8, 0);
  max_angle_ = firstFold(info_, D_);
  const bool folds = max_angle_ < kRightAngle;
  max_radius_squared_ =
      folds ? std::pow(std::tan(max_angle_), 2) : std::numeric_limits<double>::infinity();
}

std::optional<Vector2d> CameraModel::project(const Vector3d& p, PixelJacobian* J_uv_p) const {
  Vector2d d;  // distorted, in the plane z = 1
  PixelJacobian J_d_p;
  if (info_.model == DistortionModel::equidistant) {
    const double rho = std::hypot(p.x(), p.y());
    if (!(std::atan2(rho, p.z()) < max_angle_) || p.isZero(0)) return std::nullopt;
    const FisheyeFactor g = fisheyeFactor(D_, rho, p.z());
    d = g.value * p.head<2>();
    if (J_uv_p) {
      const Vector2d away = rho > 0 ? Vector2d(p.head<2>() / rho) : Vector2d::Zero();
      J_d_p << g.value * Matrix2d::Identity() + p.head<2>() * g.by_rho * away.transpose(),
          p.head<2>() * g.by_z;
    }
  } else {
    if (!(p.z() > 0)) return std::nullopt;
    const Vector2d xy = p.head<2>() / p.z();
    if (!(xy.squaredNorm() < max_radius_squared_)) return std::nullopt;
    Matrix2d J_d_xy;
    d = undistorted_ ? xy : distort(D_, xy, J_uv_p ? &J_d_xy : nullptr);
    if (J_uv_p) {
      if (undistorted_) J_d_xy.setIdentity();
      J_d_p << J_d_xy / p.z(), -J_d_xy * xy / p.z();
    }
  }
  const auto A = info_.K.topLeftCorner<2, 2>();
  if (J_uv_p) *J_uv_p = A * J_d_p;
  return A * d + info_.K.topRightCorner<2, 1>();
}

std::optional<Vector3d> CameraModel::unproject(const Vector2d& px) const {
  const Eigen::Matrix3d& K = info_.K;
  Vector2d d;
  d.y() = (px.y() - K(1, 2)) / K(1, 1);
  d.x() = (px.x() - K(0, 2) - K(0, 1) * d.y()) / K(0, 0);
  if (!d.allFinite()) return std::nullopt;
  if (undistorted_) return Vector3d(d.x(), d.y(), 1).normalized();
  const double radius = d.norm();
  if (info_.model == DistortionModel::equidistant) {
    if (radius >= equidistant(D_, max_angle_).value) return std::nullopt;
    const double theta = undistortedRadius(info_, D_, radius, max_angle_);
    const double g = radius > 0 ? std::sin(theta) / radius : 1;
    return Vector3d(d.x() * g, d.y() * g, std::cos(theta));
  }
  // Start without tangential terms, then Newton's method with all of them.
  const double r = undistortedRadius(info_, D_, radius, std::sqrt(max_radius_squared_));
  Vector2d p = radius > 0 ? Vector2d(d * (r / radius)) : d;
  for (int i = 0; i < 20; ++i) {
    Matrix2d J;
    const Vector2d error = distort(D_, p, &J) - d;
    if (error.norm() < 1e-15 * (1 + radius)) break;
    p -= J.inverse() * error;
  }
  const bool found =
      p.squaredNorm() < max_radius_squared_ && (distort(D_, p) - d).norm() < 1e-11 * (1 + radius);
  if (!found) return std::nullopt;
  return Vector3d(p.x(), p.y(), 1).normalized();
}

}  // namespace slamscope::tracking
