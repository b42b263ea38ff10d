// SPDX-License-Identifier: MIT
#include "tracking/stated_check.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstdio>

#include "tracking/tag_scene.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr double kForget = 0.98;  // a picture; some fifty count
constexpr double kLeastPlaces = 8;
constexpr double kFurther_m = 0.05, kTurnedFurther = 0.05;  // since the picture before
constexpr double kSignificant = 7;
/// Smaller ones are nobody's mistake.
constexpr double kLeastFocal = 0.006, kLeastPoint_px = 0.3, kLeastSize = 0.008;

template <typename... Values>
std::string statement(const char* format, Values... values) {
  std::array<char, 160> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

/// One explanation: some of the four numbers, the others being as stated.
struct Explanation {
  Vector2d value = Vector2d::Zero();
  double explained = 0;  // χ²
  double sigmas = 0;
};

template <int first, int size, typename Matrix4, typename Vector4>
Explanation explain(const Matrix4& H, const Vector4& g, double chi2, double dof) {
  const Eigen::Matrix<double, size, size> A = H.template block<size, size>(first, first);
  const Eigen::Matrix<double, size, 1> b = g.template segment<size>(first);
  const Eigen::Matrix<double, size, 1> x = A.inverse() * b;
  Explanation result;
  result.value.template head<size>() = x;
  result.explained = b.dot(x);
  const double noise = std::max(1.0, (chi2 - result.explained) / std::max(1.0, dof));
  result.sigmas = std::sqrt(std::max(0.0, result.explained / noise));
  return result;
}

}  // namespace

void StatedCheck::add(const EyeCamera& eye, const TagLayout& layout,
                      std::span<const HeadSight> sights, const HeadFit& fit, std::size_t camera) {
  const Eigen::Isometry3d& here = fit.motion.T_world_head;
  if (before_ && (before_->translation() - here.translation()).norm() < kFurther_m &&
      rotationLog(before_->linear().transpose() * here.linear()).norm() < kTurnedFurther) {
    return;
  }
  Matrix6d A = Matrix6d::Zero();
  Eigen::Matrix<double, 6, kSize> B = Eigen::Matrix<double, 6, kSize>::Zero();
  Matrix4 C = Matrix4::Zero();
  Eigen::Matrix<double, 6, 1> a = Eigen::Matrix<double, 6, 1>::Zero();
  Vector4 c = Vector4::Zero();
  double chi2 = 0;
  int count = 0;
  const Vector2d principal = eye.model.K().topRightCorner<2, 1>();
  for (std::size_t i = 0; i < sights.size(); ++i) {
    const HeadSight& sight = sights[i];
    if (sight.camera != camera || !fit.used[i]) continue;
    HeadJacobian J;
    const auto px = projectAt(eye, fit.motion, sight.p_world, sight.delay, &J);
    if (!px) continue;
    const Vector3d centre = layout.find(sight.tag)->T_world_tag.translation();
    // A point that moves is a head that moves the other way.
    const Vector3d outward = here.linear().transpose() * (sight.p_world - centre);
    Eigen::Matrix<double, 2, kSize> J_stated;
    J_stated << *px - principal, Eigen::Matrix2d::Identity(), -J.leftCols<3>() * outward;
    const double weight = 1 / (sight.sigma_px * sight.sigma_px);
    const Vector2d r = sight.px - *px;
    const auto J_pose = J.leftCols<6>();
    A += weight * J_pose.transpose() * J_pose;
    B += weight * J_pose.transpose() * J_stated;
    C += weight * J_stated.transpose() * J_stated;
    a += weight * J_pose.transpose() * r;
    c += weight * J_stated.transpose() * r;
    chi2 += weight * r.squaredNorm();
    ++count;
  }
  if (count < 8) return;
  const Eigen::LLT<Matrix6d> solver(A);
  before_ = here;
  H_ = kForget * H_ + C - B.transpose() * solver.solve(B);
  g_ = kForget * g_ + c - B.transpose() * solver.solve(a);
  chi2_ = kForget * chi2_ + chi2 - a.dot(solver.solve(a));
  dof_ = kForget * dof_ + 2 * count - 6;
  pictures_ = kForget * pictures_ + 1;
}

std::optional<std::string> StatedCheck::named() const {
  if (pictures_ < kLeastPlaces) return std::nullopt;
  const double all = g_.dot(H_.llt().solve(g_));
  const Explanation focal = explain<0, 1>(H_, g_, chi2_, dof_);
  const Explanation point = explain<1, 2>(H_, g_, chi2_, dof_);
  const Explanation size = explain<3, 1>(H_, g_, chi2_, dof_);
  const double best = std::max({focal.explained, point.explained, size.explained});
  const auto stands = [&](const Explanation& one, double amount, double least) {
    return one.explained == best && best > 0.5 * all && one.sigmas > kSignificant && amount > least;
  };
  const double f = focal.value.x(), s = size.value.x();
  if (stands(focal, std::abs(f), kLeastFocal)) {
    return statement("focal length of the %s camera looks %.1f %% %s than stated", camera_.c_str(),
                     100 * std::abs(std::expm1(f)), f > 0 ? "longer" : "shorter");
  }
  if (stands(point, point.value.norm(), kLeastPoint_px)) {
    return statement(
        "principal point of the %s camera looks %.1f, %.1f px off: are pixels counted from their "
        "centres?",
        camera_.c_str(), point.value.x(), point.value.y());
  }
  if (stands(size, std::abs(s), kLeastSize)) {
    return statement("tags look %.1f %% %s than stated", 100 * std::abs(std::expm1(s)),
                     s > 0 ? "larger" : "smaller");
  }
  return std::nullopt;
}

}  // namespace slamscope::tracking
