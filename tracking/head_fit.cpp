// SPDX-License-Identifier: MIT
#include "tracking/head_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "tracking/robust_descent.hpp"
#include "tracking/symmetric_solve.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Vector2d;

constexpr double kAtRestRoughly = 1e-3, kAtRest = 1e-9;  // change of cost
constexpr double kNeverOutlier_px = 0.5;                 // whatever the sigmas say

/// Information of the prior; of its velocities alone where the pose isn't believed.
Matrix12d informationOf(const HeadFitProblem& problem) {
  Matrix12d information = Matrix12d::Zero();
  if (problem.pose_believed) {
    information = inverseOfSymmetric(problem.prior.covariance.topLeftCorner<12, 12>());
  } else {
    information.bottomRightCorner<6, 6>() =
        inverseOfSymmetric(problem.prior.covariance.block<6, 6>(6, 6));
  }
  return information;
}

class HeadSolver {
 public:
  explicit HeadSolver(const HeadFitProblem& problem)
      : problem_(problem),
        information_(informationOf(problem)),
        used_(problem.sights.size(), true) {}

  std::optional<HeadFit> solve(HeadMotion motion) {
    if (used_.empty()) return std::nullopt;
    const auto narrowed = narrowDown(
        motion, [&](const HeadMotion& at) { return scaleOf(at); },
        [&](const HeadMotion& at, double scale) { return descendAt(at, scale, kAtRestRoughly); });
    if (!narrowed) return std::nullopt;
    motion = *narrowed;
    gate(motion, scaleOf(motion));
    if (!determined()) return std::nullopt;
    const auto last = descendAt(motion, kNoOutliers, kAtRest);
    if (!last) return std::nullopt;
    return report(*last);
  }

 private:
  /// How much larger the errors are than the sigmas say.
  [[nodiscard]] double scaleOf(const HeadMotion& motion) const {
    std::vector<double> errors = headDistances(problem_.eyes, problem_.sights, motion);
    for (std::size_t i = 0; i < errors.size(); ++i) errors[i] /= problem_.sights[i].sigma_px;
    return errorScale(std::move(errors));
  }

  [[nodiscard]] NormalEquations<12> linearise(const HeadMotion& motion, double scale) const {
    NormalEquations<12> system;
    for (std::size_t i = 0; i < used_.size(); ++i) {
      if (!used_[i]) continue;
      const HeadSight& sight = problem_.sights[i];
      HeadJacobian J;
      const auto px =
          projectAt(problem_.eyes[sight.camera], motion, sight.p_world, sight.delay, &J);
      if (!px) {
        system.valid = false;
        return system;
      }
      const Vector2d r = (sight.px - *px) / sight.sigma_px;
      J /= sight.sigma_px;
      const auto [weight, cost] = robustTerm(r.squaredNorm(), scale);
      system.cost += cost;
      if (sight.delay == 0) {  // velocities move nothing: half of J is zero
        const auto J_pose = J.leftCols<6>();
        system.H.topLeftCorner<6, 6>().noalias() += weight * J_pose.transpose() * J_pose;
        system.g.head<6>().noalias() += weight * J_pose.transpose() * r;
      } else {
        system.H.noalias() += weight * J.transpose() * J;
        system.g.noalias() += weight * J.transpose() * r;
      }
    }
    const Vector12d off = difference(problem_.prior, motion);
    system.H += information_;
    system.g -= information_ * off;
    system.cost += off.dot(information_ * off);
    return system;
  }

  [[nodiscard]] std::optional<HeadMotion> descendAt(const HeadMotion& motion, double scale,
                                                    double tolerance) const {
    return descend(
        motion, [&](const HeadMotion& at) { return linearise(at, scale); }, corrected, tolerance);
  }

  /// Leaves outliers out, and squares of which two corners are.
  void gate(const HeadMotion& motion, double scale) {
    const auto distances = headDistances(problem_.eyes, problem_.sights, motion);
    std::map<int, int> outliers;
    for (std::size_t i = 0; i < used_.size(); ++i) {
      const HeadSight& sight = problem_.sights[i];
      used_[i] = distances[i] < problem_.gate_sigmas * scale * sight.sigma_px ||
                 distances[i] < kNeverOutlier_px;
      if (!used_[i]) ++outliers[sight.square];
    }
    for (std::size_t i = 0; i < used_.size(); ++i) {
      const auto square = outliers.find(problem_.sights[i].square);
      if (square != outliers.end() && square->second >= 2) used_[i] = false;
    }
  }

  [[nodiscard]] bool determined() const {
    const auto count = std::count(used_.begin(), used_.end(), true);
    return count >= (problem_.pose_believed ? 1 : 4);
  }

  [[nodiscard]] HeadFit report(const HeadMotion& motion) const {
    HeadFit fit;
    fit.motion = motion;
    fit.used = used_;
    fit.used_count = static_cast<int>(std::count(used_.begin(), used_.end(), true));
    const auto distances = headDistances(problem_.eyes, problem_.sights, motion);
    double chi2 = 0, px2 = 0;
    const double most = problem_.gate_sigmas * problem_.gate_sigmas;
    for (std::size_t i = 0; i < used_.size(); ++i) {
      const double e2 = std::pow(distances[i] / problem_.sights[i].sigma_px, 2);
      fit.cost += std::min(e2, most);
      if (!used_[i]) continue;
      chi2 += e2;
      px2 += distances[i] * distances[i];
    }
    const Vector12d off = difference(problem_.prior, motion);
    fit.cost += off.dot(information_ * off);
    fit.residual_px = std::sqrt(px2 / fit.used_count);
    const double dof = std::max(1, 2 * fit.used_count - 6);
    const double excess = chi2 / dof > 1 + 3 * std::sqrt(2 / dof) ? chi2 / dof : 1;
    fit.agrees = excess == 1 && fit.used_count == static_cast<int>(used_.size());
    // The corners' share of the information alone is worth less where they don't fit.
    const Matrix12d H = (linearise(motion, kNoOutliers).H - information_) / excess + information_;
    const Matrix12d P = inverseOfSymmetric(H);
    fit.motion = conditioned(problem_.prior, motion, P);
    if (problem_.pose_believed) fit.surprise = surpriseOf(off, P);
    return fit;
  }

  /// Of the posterior pose under the prior: what was learnt has covariance P − P⁺.
  [[nodiscard]] double surpriseOf(const Vector12d& off, const Matrix12d& after) const {
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    using Matrix6 = Eigen::Matrix<double, 6, 6>;
    const Matrix6 P = problem_.prior.covariance.topLeftCorner<6, 6>();
    const Matrix6 learnt =
        P - after.topLeftCorner<6, 6>() + 1e-6 * P;  // differences of what was inverted
    const Vector6 step = off.head<6>();
    return step.dot(Vector6(solveSymmetric(learnt, step)));
  }

  const HeadFitProblem& problem_;
  Matrix12d information_;
  std::vector<bool> used_;
};

/// See fitHeadWarily.
double discord(const HeadFitProblem& problem, const HeadMotion& motion) {
  const auto distances = headDistances(problem.eyes, problem.sights, motion);
  double sum = 0;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double unit = 3 * problem.sights[i].sigma_px;
    sum += std::log1p(std::pow(std::min(distances[i], 1e3) / unit, 2));
  }
  return sum;
}

}  // namespace

std::optional<HeadFit> fitHead(const HeadFitProblem& problem, const HeadMotion& start) {
  return HeadSolver(problem).solve(start);
}

std::optional<HeadFit> fitHeadWarily(const HeadFitProblem& problem, const HeadMotion& start) {
  constexpr std::size_t kMostTags = 16;
  auto fit = fitHead(problem, start);
  if (fit && fit->agrees) return fit;
  std::set<int> tags;
  for (const HeadSight& sight : problem.sights) tags.insert(sight.tag);
  if (tags.size() < 3 || tags.size() > kMostTags) return fit;
  HeadMotion best = fit ? fit->motion : start;
  double least = fit ? discord(problem, best) : std::numeric_limits<double>::infinity();
  const double first = least;
  for (const int without : tags) {
    std::vector<HeadSight> rest;
    for (const HeadSight& sight : problem.sights) {
      if (sight.tag != without) rest.push_back(sight);
    }
    HeadFitProblem smaller = problem;
    smaller.sights = rest;
    const auto other = fitHead(smaller, best);
    if (!other) continue;
    const double sum = discord(problem, other->motion);
    if (sum >= least) continue;
    least = sum;
    best = other->motion;
  }
  if (least >= first) return fit;
  best.covariance = problem.prior.covariance;
  auto again = fitHead(problem, best);
  return again && discord(problem, again->motion) < first ? again : fit;
}

std::vector<double> headDistances(std::span<const EyeCamera> eyes,
                                  std::span<const HeadSight> sights, const HeadMotion& motion) {
  std::vector<double> distances;
  distances.reserve(sights.size());
  for (const HeadSight& sight : sights) {
    const auto px = projectAt(eyes[sight.camera], motion, sight.p_world, sight.delay);
    distances.push_back(px ? (sight.px - *px).norm() : std::numeric_limits<double>::infinity());
  }
  return distances;
}

double headMisfit(std::span<const double> distances_px) {
  constexpr double kUnit_px = 0.5, kOutOfView_px = 1e3;
  double sum = 0;
  for (const double distance : distances_px) {
    sum += std::log1p(std::pow(std::min(distance, kOutOfView_px) / kUnit_px, 2));
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, distances_px.size()));
}

}  // namespace slamscope::tracking
