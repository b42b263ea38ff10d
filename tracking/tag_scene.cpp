// SPDX-License-Identifier: MIT
#include "tracking/tag_scene.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Vector2d, Eigen::Vector3d;
using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix29d = Eigen::Matrix<double, 2, 9>;

constexpr int kIterations = 40;
constexpr int kRounds = 4;
constexpr double kRoughly = 1e-3, kExactly = 1e-10;  // change of cost at rest
constexpr double kFullWeight = 4;                    // sigmas
constexpr double kNoLimit = 1e9;                     // scale of errors at which none is an outlier
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

ScenePose moved(const ScenePose& pose, const Vector9d& step) {
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

struct Linearised {
  Matrix9d H = Matrix9d::Zero();
  Vector9d g = Vector9d::Zero();
  double cost = 0;
  bool valid = true;
};

/// Of the smaller third of the distances: up to nearly two thirds of the corners may be wrong.
constexpr double kScaleQuantile = 0.35;

double quantile(std::vector<double> values, double part) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * double(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

class Solver {
 public:
  Solver(const CameraModel& camera, const SceneProblem& problem)
      : camera_(camera), problem_(problem), used_(problem.corners.size(), true) {
    free_.setZero();
    if (problem.solve_camera) free_.head<6>().setOnes();
    if (problem.solve_map) free_.tail<3>().setOnes();
  }

  /// How much larger the errors are than the sigmas say, by the same quantile of a 2D unit
  /// Gaussian.
  [[nodiscard]] double scale(const ScenePose& pose) const {
    static const double unit = std::sqrt(-2 * std::log(1 - kScaleQuantile));
    return std::max(
        1.0, quantile(sceneDistances(camera_, problem_.corners, pose), kScaleQuantile) / unit);
  }

  [[nodiscard]] Linearised linearise(const ScenePose& pose, double scale) const {
    Linearised result;
    const double limit = kFullWeight * scale;
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
      // Full weight within the limit, a logarithm's beyond it.
      const double e2 = r.squaredNorm(), l2 = limit * limit;
      const double weight = e2 <= l2 ? 1 : l2 / e2;
      result.cost += e2 <= l2 ? e2 : l2 * (1 + std::log(e2 / l2));
      result.H += weight * J.transpose() * J;
      result.g += weight * J.transpose() * r;
    }
    addPrior(pose, result);
    for (int k = 0; k < 9; ++k) {
      if (free_[k] == 0) result.H(k, k) = 1;
    }
    return result;
  }

  /// Levenberg's method from `pose`; nothing where it can't start.
  [[nodiscard]] std::optional<ScenePose> descend(ScenePose pose, double scale,
                                                 double tolerance) const {
    double damping = 1e-6;
    Linearised at = linearise(pose, scale);
    if (!at.valid) return std::nullopt;
    for (int i = 0; i < kIterations; ++i) {
      Matrix9d H = at.H;
      H.diagonal() *= 1 + damping;
      const Vector9d step = H.ldlt().solve(at.g);
      if (!step.allFinite()) return std::nullopt;
      const ScenePose candidate = moved(pose, step);
      const Linearised next = linearise(candidate, scale);
      if (next.valid && next.cost <= at.cost) {
        const bool at_rest = at.cost - next.cost < tolerance * (1 + at.cost);
        pose = candidate;
        at = next;
        damping = std::max(1e-9, damping * 0.1);
        if (at_rest) break;
      } else if ((damping *= 10) > 1e6) {
        break;
      }
    }
    return pose;
  }

  [[nodiscard]] std::optional<SceneFit> solve(ScenePose pose) {
    if (used_.empty()) return std::nullopt;
    // Ever narrower, so that outliers which share in a first compromise lose their hold on it.
    double s = problem_.robust ? scale(pose) : kNoLimit;
    for (int round = 0; problem_.robust && round < kRounds; ++round) {
      const auto better = descend(pose, s, kRoughly);
      if (!better) return std::nullopt;
      pose = *better;
      const double narrower = std::max(1.0, std::min(s / 3, scale(pose)));
      if (narrower == s) break;
      s = narrower;
    }
    s = problem_.robust ? scale(pose) : kNoLimit;
    const auto all = sceneDistances(camera_, problem_.corners, pose);
    for (std::size_t i = 0; i < used_.size(); ++i) {
      used_[i] = all[i] < problem_.gate_sigmas * s ||
                 all[i] * problem_.corners[i].sigma_px < kLeastOutlier_px;
    }
    const auto count = std::count(used_.begin(), used_.end(), true);
    if (freedom(static_cast<int>(count)) < 0) return std::nullopt;
    // Without the outliers, all weights are one.
    const auto last = descend(pose, kNoLimit, kExactly);
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

  void addPrior(const ScenePose& pose, Linearised& result) const {
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
    fit.covariance =
        excess * (free_ * free_.transpose()).cwiseProduct(linearise(pose, kNoLimit).H.inverse());
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
