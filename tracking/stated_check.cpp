// SPDX-License-Identifier: MIT
#include "tracking/stated_check.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <vector>

#include "tracking/median.hpp"
#include "tracking/symmetric_solve.hpp"
#include "tracking/tag_scene.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr double kForget = 0.98;  // a picture; some fifty count
constexpr double kLeastPlaces = 8;
constexpr double kFurther_m = 0.05, kTurnedFurther = 0.05;  // since the picture before
constexpr double kSignificant = 7;
constexpr std::size_t kLeastTags = 3;
constexpr std::size_t kRemembered = 10;  // pictures
constexpr double kFits_px = 0.7;  // a median of the corners' distances that is no cause to complain
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

template <int first, int size>
Explanation explain(const Eigen::Matrix4d& H, const Eigen::Vector4d& g, double chi2, double dof) {
  const Eigen::Matrix<double, size, 1> b = g.template segment<size>(first);
  const Eigen::Matrix<double, size, 1> x =
      solveSymmetric(H.template block<size, size>(first, first), b);
  Explanation result;
  result.value.template head<size>() = x;
  result.explained = b.dot(x);
  const double noise = std::max(1.0, (chi2 - result.explained) / std::max(1.0, dof));
  result.sigmas = std::sqrt(std::max(0.0, result.explained / noise));
  return result;
}

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Normal equations of one picture: its pose (A, a), what was stated (C, c), both (B).
struct Sums {
  Matrix6d A = Matrix6d::Zero();
  Eigen::Matrix<double, 6, 4> B = Eigen::Matrix<double, 6, 4>::Zero();
  Eigen::Matrix4d C = Eigen::Matrix4d::Zero();
  Vector6 a = Vector6::Zero();
  Eigen::Vector4d c = Eigen::Vector4d::Zero();
  double chi2 = 0;
  int count = 0;

  void add(const EyeCamera& eye, const MappedTag& tag, const HeadSight& sight,
           const HeadMotion& head, double weight) {
    HeadJacobian J;
    const auto px = projectAt(eye, head, sight.p_world, sight.delay, &J);
    if (!px) return;
    const Vector2d principal = eye.model.K().topRightCorner<2, 1>();
    // A point that moves is a head that moves the other way.
    const Vector3d outward =
        head.T_world_head.linear().transpose() * (sight.p_world - tag.T_world_tag.translation());
    Eigen::Matrix<double, 2, 4> J_stated;
    J_stated << *px - principal, Eigen::Matrix2d::Identity(), -J.leftCols<3>() * outward;
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
};

}  // namespace

void StatedCheck::add(const EyeCamera& eye, const TagLayout& layout,
                      std::span<const HeadSight> sights, const HeadMotion& head,
                      std::size_t camera) {
  std::vector<HeadSight> own;
  std::set<int> tags;
  for (const HeadSight& sight : sights) {
    if (sight.camera != camera) continue;
    own.push_back(sight);
    own.back().camera = 0;  // the only one that learn() knows
    tags.insert(sight.tag);
  }
  if (tags.size() < kLeastTags) return;
  learn(eye, layout, own, head);
}

void StatedCheck::learn(const EyeCamera& eye, const TagLayout& layout,
                        std::span<const HeadSight> sights, const HeadMotion& head) {
  const std::vector<double> distances = headDistances(std::span(&eye, 1), sights, head);
  const double median = medianOf(distances);
  if (!std::isfinite(median)) return;
  medians_px_.push_back(median);
  if (medians_px_.size() > kRemembered) medians_px_.pop_front();
  const Eigen::Isometry3d& here = head.T_world_head;
  if (before_ && (before_->translation() - here.translation()).norm() < kFurther_m &&
      rotationLog(before_->linear().transpose() * here.linear()).norm() < kTurnedFurther) {
    return;
  }
  before_ = here;
  Sums sums;
  for (std::size_t i = 0; i < sights.size(); ++i) {
    const HeadSight& sight = sights[i];
    const double usual = 3 * std::max(median, sight.sigma_px);
    const double weight =
        1 / (sight.sigma_px * sight.sigma_px) / (1 + std::pow(distances[i] / usual, 2));
    sums.add(eye, *layout.find(sight.tag), sight, head, weight);
  }
  const Matrix6d P = inverseOfSymmetric(sums.A);
  const Eigen::Matrix<double, 4, 6> B_P = sums.B.transpose() * P;
  H_ = kForget * H_ + sums.C - B_P * sums.B;
  g_ = kForget * g_ + sums.c - B_P * sums.a;
  chi2_ = kForget * chi2_ + sums.chi2 - sums.a.dot(P * sums.a);
  dof_ = kForget * dof_ + 2 * sums.count - 6;
  pictures_ = kForget * pictures_ + 1;
}

std::optional<std::string> StatedCheck::named() const {
  const auto explanation = explained();
  return explanation ? explanation : unexplained();
}

std::optional<std::string> StatedCheck::unexplained() const {
  if (medians_px_.size() < kRemembered) return std::nullopt;
  const double usual = medianOf({medians_px_.begin(), medians_px_.end()});
  if (usual < kFits_px) return std::nullopt;
  return statement(
      "corners in the picture of %s lie %.1f px off: its lens, its readout or the layout is not as "
      "stated",
      camera_.c_str(), usual);
}

std::optional<std::string> StatedCheck::explained() const {
  if (pictures_ < kLeastPlaces) return std::nullopt;
  const double all = g_.dot(Eigen::Vector4d(solveSymmetric(H_, g_)));
  const Explanation focal = explain<0, 1>(H_, g_, chi2_, dof_);
  const Explanation point = explain<1, 2>(H_, g_, chi2_, dof_);
  const Explanation size = explain<3, 1>(H_, g_, chi2_, dof_);
  const double best = std::max({focal.explained, point.explained, size.explained});
  const auto stands = [&](const Explanation& one, double amount, double least) {
    return one.explained == best && best > 0.5 * all && one.sigmas > kSignificant && amount > least;
  };
  const double f = focal.value.x(), s = size.value.x();
  if (stands(focal, std::abs(f), kLeastFocal)) {
    return statement("focal length of %s looks %.1f %% %s than stated", camera_.c_str(),
                     100 * std::abs(std::expm1(f)), f > 0 ? "longer" : "shorter");
  }
  if (stands(point, point.value.norm(), kLeastPoint_px)) {
    return statement(
        "principal point of %s looks %.1f, %.1f px off: are pixels counted from their "
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
