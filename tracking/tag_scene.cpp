// SPDX-License-Identifier: MIT
#include "tracking/tag_scene.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "tracking/robust_descent.hpp"
#include "tracking/symmetric_solve.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Vector2d, Eigen::Vector3d;
using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;
using Matrix29d = Eigen::Matrix<double, 2, 9>;

constexpr double kRoughly = 1e-3, kExactly = 1e-10;  // change of cost at rest
/// Whatever the sigmas say, a corner is no outlier below it.
constexpr double kLeastOutlier_px = 0.5;

Isometry3d turned(const Isometry3d& T, const Vector3d& rho, const Vector3d& phi) {
  Isometry3d step = Isometry3d::Identity();
  if (phi.norm() > 0) {
    step.linear() = Eigen::AngleAxisd(phi.norm(), phi.normalized()).toRotationMatrix();
  }
  step.translation() = rho;
  Isometry3d moved = T * step;
  moved.linear() = Eigen::Quaterniond(moved.linear()).normalized().toRotationMatrix();
  return moved;
}

ScenePose perturbed(const ScenePose& pose, const Vector9d& step) {
  return {turned(pose.T_camera_world, step.head<3>(), step.segment<3>(3)),
          turned(pose.T_world_map, {step[6], step[7], 0}, {0, 0, step[8]})};
}

/// Pixel where the pose puts the corner, and how it moves with the nine perturbations.
std::optional<Vector2d> predict(const CameraModel& camera, const CornerSight& corner,
                                const ScenePose& pose, Matrix29d* J = nullptr) {
  const Vector3d p_world = corner.on_map ? pose.T_world_map * corner.p : corner.p;
  PixelJacobian J_uv_p;
  const auto px = camera.project(pose.T_camera_world * p_world, J ? &J_uv_p : nullptr);
  if (!px || !J) return px;
  const PixelJacobian J_world = J_uv_p * pose.T_camera_world.linear();
  J->leftCols<3>() = J_world;
  J->middleCols<3>(3) = -J_world * skew(p_world);
  J->rightCols<3>().setZero();
  if (corner.on_map) {
    const PixelJacobian J_map = J_world * pose.T_world_map.linear();
    J->col(6) = J_map.col(0);
    J->col(7) = J_map.col(1);
    J->col(8) = J_map * Vector3d::UnitZ().cross(corner.p);
  }
  return px;
}

class Solver {
 public:
  Solver(const CameraModel& camera, const SceneProblem& problem)
      : camera_(camera), problem_(problem), used_(problem.corners.size(), true) {
    free_.setZero();
    if (problem.solve_camera) free_.head<6>().setOnes();
    if (problem.solve_map) free_.tail<3>().setOnes();
  }

  /// How much larger the errors are than the sigmas say.
  [[nodiscard]] double scale(const ScenePose& pose) const {
    return errorScale(sceneDistances(camera_, problem_.corners, pose));
  }

  [[nodiscard]] NormalEquations<9> linearise(const ScenePose& pose, double scale) const {
    NormalEquations<9> result;
    for (std::size_t i = 0; i < used_.size(); ++i) {
      if (!used_[i]) continue;
      const CornerSight& corner = problem_.corners[i];
      Matrix29d J;
      const auto px = predict(camera_, corner, pose, &J);
      if (!px) {
        result.valid = false;
        return result;
      }
      const Vector2d r = (corner.px - *px) / corner.sigma_px;
      J = (J / corner.sigma_px * free_.asDiagonal()).eval();
      const auto [weight, cost] = robustTerm(r.squaredNorm(), scale);
      result.cost += cost;
      result.H += weight * J.transpose() * J;
      result.g += weight * J.transpose() * r;
    }
    addPrior(pose, result);
    for (int k = 0; k < 9; ++k) {
      if (free_[k] == 0) result.H(k, k) = 1;
    }
    return result;
  }

  [[nodiscard]] std::optional<ScenePose> descendAt(const ScenePose& pose, double scale,
                                                   double tolerance) const {
    return descend(
        pose, [&](const ScenePose& at) { return linearise(at, scale); }, perturbed, tolerance);
  }

  [[nodiscard]] std::optional<SceneFit> solve(ScenePose pose) {
    if (used_.empty()) return std::nullopt;
    if (problem_.robust) {
      const auto narrowed = narrowDown(
          pose, [&](const ScenePose& at) { return scale(at); },
          [&](const ScenePose& at, double s) { return descendAt(at, s, kRoughly); });
      if (!narrowed) return std::nullopt;
      pose = *narrowed;
    }
    const double s = problem_.robust ? scale(pose) : kNoOutliers;
    const auto all = sceneDistances(camera_, problem_.corners, pose);
    for (std::size_t i = 0; i < used_.size(); ++i) {
      used_[i] = all[i] < problem_.gate_sigmas * s ||
                 all[i] * problem_.corners[i].sigma_px < kLeastOutlier_px;
    }
    const auto count = std::count(used_.begin(), used_.end(), true);
    if (freedom(static_cast<int>(count)) < 0) return std::nullopt;
    // Without the outliers, all weights are one.
    const auto last = descendAt(pose, kNoOutliers, kExactly);
    if (!last) return std::nullopt;
    return report(*last, static_cast<int>(count));
  }

 private:
  [[nodiscard]] bool prior() const {
    return problem_.prior_T_camera_world && problem_.solve_camera;
  }

  /// What is measured beyond what is sought.
  [[nodiscard]] int freedom(int corners) const {
    return 2 * corners + (prior() ? 6 : 0) - static_cast<int>(free_.sum());
  }

  void addPrior(const ScenePose& pose, NormalEquations<9>& result) const {
    if (!prior()) return;
    const Isometry3d off = problem_.prior_T_camera_world->inverse() * pose.T_camera_world;
    const Eigen::AngleAxisd turn(off.linear());
    Eigen::Matrix<double, 6, 1> d;
    d << off.translation(), turn.angle() * turn.axis();
    result.H.topLeftCorner<6, 6>() += problem_.prior_information;
    result.g.head<6>() -= problem_.prior_information * d;
    result.cost += d.dot(problem_.prior_information * d);
  }

  [[nodiscard]] SceneFit report(const ScenePose& pose, int count) const {
    SceneFit fit;
    fit.pose = pose;
    fit.used = used_;
    fit.used_count = count;
    double chi2 = 0, px2 = 0;
    for (std::size_t i = 0; i < used_.size(); ++i) {
      if (!used_[i]) continue;
      const CornerSight& corner = problem_.corners[i];
      const auto px = predict(camera_, corner, pose);
      const double distance2 = (corner.px - *px).squaredNorm();
      px2 += distance2;
      chi2 += distance2 / (corner.sigma_px * corner.sigma_px);
    }
    fit.residual_px = std::sqrt(px2 / count);
    const double dof = std::max(1, freedom(count));
    const double excess = chi2 / dof > 1 + 3 * std::sqrt(2 / dof) ? chi2 / dof : 1;
    const Matrix9d P = inverseOfSymmetric(linearise(pose, kNoOutliers).H);
    fit.covariance = excess * (free_.asDiagonal() * P * free_.asDiagonal());
    return fit;
  }

  const CameraModel& camera_;
  const SceneProblem& problem_;
  std::vector<bool> used_;
  Vector9d free_;  // 1 for what is solved for, else 0
};

}  // namespace

std::optional<SceneFit> fitScene(const CameraModel& camera, const SceneProblem& problem,
                                 const ScenePose& start) {
  return Solver(camera, problem).solve(start);
}

double sceneMisfit(const CameraModel& camera, const std::vector<CornerSight>& corners,
                   const ScenePose& pose) {
  constexpr double kUnit_px = 0.5, kOutOfView_px = 1e3;
  double sum = 0;
  for (const CornerSight& corner : corners) {
    const auto px = predict(camera, corner, pose);
    const double distance = px ? (corner.px - *px).norm() : kOutOfView_px;
    sum += std::log1p(std::pow(distance / kUnit_px, 2));
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, corners.size()));
}

std::vector<double> sceneDistances(const CameraModel& camera,
                                   const std::vector<CornerSight>& corners, const ScenePose& pose) {
  std::vector<double> result;
  for (const CornerSight& corner : corners) {
    const auto px = predict(camera, corner, pose);
    result.push_back(px ? (corner.px - *px).norm() / corner.sigma_px
                        : std::numeric_limits<double>::infinity());
  }
  return result;
}

Eigen::Matrix3d skew(const Vector3d& v) {
  Eigen::Matrix3d S;
  S << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return S;
}

Eigen::Matrix<double, 6, 9> mapPerturbation(const Isometry3d& T_world_map) {
  const Isometry3d T_map_world = T_world_map.inverse();
  const Eigen::Matrix3d R = T_map_world.linear();
  Eigen::Matrix<double, 6, 9> M = Eigen::Matrix<double, 6, 9>::Zero();
  M.topLeftCorner<3, 3>() = R;  // adjoint of T_map_world
  M.block<3, 3>(0, 3) = skew(T_map_world.translation()) * R;
  M.block<3, 3>(3, 3) = R;
  M(0, 6) = M(1, 7) = M(5, 8) = 1;
  return M;
}

}  // namespace slamscope::tracking
