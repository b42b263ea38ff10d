// SPDX-License-Identifier: MIT
#include "tests/batch/batch_graph.hpp"

#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>

#include <Eigen/Dense>
#include <algorithm>

#include "slam/angle.hpp"
#include "slam/models.hpp"

namespace slamscope::slam::testing {
namespace {

/// Ceres keeps Jacobians row by row.
template <int Rows, int Cols>
using RowMajor = Eigen::Map<Eigen::Matrix<double, Rows, Cols, Eigen::RowMajor>>;

template <int Size>
Eigen::Matrix<double, Size, Size> whitening(const Eigen::Matrix<double, Size, Size>& covariance) {
  const Eigen::Matrix<double, Size, Size> L = covariance.llt().matrixL();
  return L.inverse();
}

/// from⁻¹ to, less what the odometry says, whitened.
class OdometryCost final : public ceres::SizedCostFunction<3, 3, 3> {
 public:
  OdometryCost(const Eigen::Vector3d& moved, const Eigen::Matrix3d& M)
      : moved_(moved), root_(whitening<3>(M)) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Map<const Eigen::Vector3d> from(parameters[0]);
    const Eigen::Map<const Eigen::Vector3d> to(parameters[1]);
    Eigen::Vector3d error = incrementBetween(from, to);
    const Eigen::Vector2d seen = error.head<2>();
    error -= moved_;
    error[2] = wrapAngle(error[2]);
    Eigen::Map<Eigen::Vector3d>{residuals} = root_ * error;
    if (jacobians == nullptr) return true;
    const double c = std::cos(from[2]);
    const double s = std::sin(from[2]);
    Eigen::Matrix3d by_to = Eigen::Matrix3d::Identity();
    by_to.topLeftCorner<2, 2>() << c, s, -s, c;
    Eigen::Matrix3d by_from = -by_to;
    by_from(0, 2) = seen.y();
    by_from(1, 2) = -seen.x();
    if (jacobians[0] != nullptr) RowMajor<3, 3>{jacobians[0]} = root_ * by_from;
    if (jacobians[1] != nullptr) RowMajor<3, 3>{jacobians[1]} = root_ * by_to;
    return true;
  }

 private:
  Eigen::Vector3d moved_;
  Eigen::Matrix3d root_;
};

class SightingCost final : public ceres::SizedCostFunction<2, 3, 2> {
 public:
  SightingCost(const Eigen::Vector2d& z, const Eigen::Matrix2d& R)
      : z_(z), root_(whitening<2>(R)) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Vector3d pose = Eigen::Map<const Eigen::Vector3d>(parameters[0]);
    const Eigen::Vector2d feature = Eigen::Map<const Eigen::Vector2d>(parameters[1]);
    const Eigen::Vector2d z = observeFeature(Sensor::relative_position, pose, feature);
    Eigen::Map<Eigen::Vector2d>{residuals} = root_ * (z - z_);
    if (jacobians == nullptr) return true;
    const auto [H_v, H_f] = observeJacobians(Sensor::relative_position, pose, feature);
    if (jacobians[0] != nullptr) RowMajor<2, 3>{jacobians[0]} = root_ * H_v;
    if (jacobians[1] != nullptr) RowMajor<2, 2>{jacobians[1]} = root_ * H_f;
    return true;
  }

 private:
  Eigen::Vector2d z_;
  Eigen::Matrix2d root_;
};

std::size_t poseAt(const Recording& recording, std::chrono::nanoseconds time) {
  const auto at = std::lower_bound(
      recording.odometry.begin(), recording.odometry.end(), time,
      [](const OdometryEntry& entry, std::chrono::nanoseconds t) { return entry.time < t; });
  return static_cast<std::size_t>(at - recording.odometry.begin());
}

}  // namespace

BatchGraph::BatchGraph(const Recording& recording)
    : recording_(recording), poses_(recording.odometry.size(), Eigen::Vector3d::Zero()) {
  for (std::size_t k = 1; k < poses_.size(); ++k) {
    poses_[k] = movePose(poses_[k - 1], recording.odometry[k].motion);
  }
}

void BatchGraph::start(const Snapshot& snapshot) {
  const std::size_t now = poseAt(recording_, snapshot.time);
  poses_.at(now) = snapshot.pose;
  for (std::size_t k = now + 1; k < poses_.size(); ++k) {
    if (k > now + 200) break;  // until the next snapshot
    poses_[k] = movePose(poses_[k - 1], recording_.odometry[k].motion);
  }
  for (std::size_t k = 0; k < snapshot.ids.size(); ++k) {
    features_[snapshot.ids[k]] = snapshot.features[k];
  }
}

void BatchGraph::solve() {
  ceres::Problem problem;
  for (std::size_t k = 1; k < poses_.size(); ++k) {
    const OdometryEntry& entry = recording_.odometry[k];
    problem.AddResidualBlock(new OdometryCost(entry.motion, entry.M.value()), nullptr,
                             poses_[k - 1].data(), poses_[k].data());
  }
  for (const Sightings& group : recording_.sightings) {
    double* const pose = poses_[poseAt(recording_, group.time)].data();
    for (const Sighting& seen : group.seen) {
      problem.AddResidualBlock(new SightingCost(seen.z, seen.R.value()), nullptr, pose,
                               features_.at(seen.id).data());
    }
  }
  problem.SetParameterBlockConstant(poses_.front().data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 100;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  initial_cost_ = summary.initial_cost;
  final_cost_ = summary.final_cost;
}

}  // namespace slamscope::slam::testing
