// SPDX-License-Identifier: MIT
#include "tracking/room_bundle.hpp"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <array>
#include <limits>
#include <stdexcept>

namespace slamscope::tracking {
namespace {

using Pose = std::array<double, 6>;  // angle times axis, translation

Pose poseOfIsometry(const Eigen::Isometry3d& T) {
  const Eigen::AngleAxisd turn(T.linear());
  const Eigen::Vector3d phi = turn.angle() * turn.axis();
  return {phi.x(), phi.y(), phi.z(), T(0, 3), T(1, 3), T(2, 3)};
}

Eigen::Isometry3d isometryOf(const Pose& pose) {
  const Eigen::Vector3d phi(pose[0], pose[1], pose[2]);
  Eigen::Isometry3d T(Eigen::Translation3d(pose[3], pose[4], pose[5]));
  if (phi.norm() > 0) T.rotate(Eigen::AngleAxisd(phi.norm(), phi.normalized()));
  return T;
}

template <typename T>
void transform(const T* pose, const T* p, T* moved) {
  ceres::AngleAxisRotatePoint(pose, p, moved);
  for (int i = 0; i < 3; ++i) moved[i] += pose[3 + i];
}

struct Reprojection {
  const BundleCorner& corner;

  template <typename T>
  bool operator()(const T* T_camera_world, const T* T_world_tag, T* residual) const {
    const T p_tag[3] = {T(corner.p_tag.x()), T(corner.p_tag.y()), T(corner.p_tag.z())};
    T p_world[3], p_camera[3];
    transform(T_world_tag, p_tag, p_world);
    transform(T_camera_world, p_world, p_camera);
    if (p_camera[2] < T(1e-3)) return false;
    const T dx = p_camera[0] / p_camera[2] - corner.xy.x();
    const T dy = p_camera[1] / p_camera[2] - corner.xy.y();
    for (int i = 0; i < 2; ++i) {
      residual[i] = corner.to_sigmas(i, 0) * dx + corner.to_sigmas(i, 1) * dy;
    }
    return true;
  }
};

/// The four corners of a tag on the floor have no height.
struct LiesOnFloor {
  double half, sigma;

  template <typename T>
  bool operator()(const T* T_world_tag, T* residual) const {
    for (int i = 0; i < 4; ++i) {
      const T p_tag[3] = {T(i == 0 || i == 3 ? -half : half), T(i < 2 ? -half : half), T(0)};
      T p_world[3];
      transform(T_world_tag, p_tag, p_world);
      residual[i] = p_world[2] / sigma;
    }
    return true;
  }
};

/// The gauge tag's centre and its x axis keep their place as seen from above.
struct StaysInPlace {
  Eigen::Isometry3d T_world_tag;

  template <typename T>
  bool operator()(const T* pose, T* residual) const {
    constexpr double kSigma = 1e-5;  // m: it is a definition
    const T x_tag[3] = {T(1), T(0), T(0)};
    T x[3];
    ceres::AngleAxisRotatePoint(pose, x_tag, x);
    residual[0] = (pose[3] - T_world_tag(0, 3)) / kSigma;
    residual[1] = (pose[4] - T_world_tag(1, 3)) / kSigma;
    residual[2] = (x[0] * T_world_tag(1, 0) - x[1] * T_world_tag(0, 0)) / kSigma;
    return true;
  }
};

void addGauge(ceres::Problem& problem, const Bundle& bundle, std::vector<Pose>& tags) {
  if (bundle.floor.empty()) {
    problem.SetParameterBlockConstant(tags[bundle.gauge].data());
    return;
  }
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<StaysInPlace, 3, 6>(
                               new StaysInPlace{bundle.T_world_tag[bundle.gauge]}),
                           nullptr, tags[bundle.gauge].data());
  for (const Bundle::OnFloor& one : bundle.floor) {
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<LiesOnFloor, 4, 6>(
                                 new LiesOnFloor{one.half, bundle.floor_sigma}),
                             nullptr, tags[one.tag].data());
  }
}

}  // namespace

void adjust(Bundle& bundle, double full_weight) {
  std::vector<Pose> cameras, tags;
  for (const auto& T : bundle.T_camera_world) cameras.push_back(poseOfIsometry(T));
  for (const auto& T : bundle.T_world_tag) tags.push_back(poseOfIsometry(T));
  ceres::Problem problem;
  for (const BundleCorner& corner : bundle.corners) {
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<Reprojection, 2, 6, 6>(new Reprojection{corner}),
        new ceres::CauchyLoss(full_weight), cameras[corner.picture].data(),
        tags[corner.tag].data());
  }
  addGauge(problem, bundle, tags);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-9;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) {
    throw std::runtime_error("bundle adjustment comes to no end: " + summary.message);
  }
  for (std::size_t i = 0; i < cameras.size(); ++i)
    bundle.T_camera_world[i] = isometryOf(cameras[i]);
  for (std::size_t i = 0; i < tags.size(); ++i) bundle.T_world_tag[i] = isometryOf(tags[i]);
}

std::vector<double> bundleDistances(const Bundle& bundle) {
  std::vector<double> distances;
  for (const BundleCorner& corner : bundle.corners) {
    const Eigen::Vector3d p =
        bundle.T_camera_world[corner.picture] * (bundle.T_world_tag[corner.tag] * corner.p_tag);
    distances.push_back(p.z() > 0 ? (corner.to_sigmas * (p.head<2>() / p.z() - corner.xy)).norm()
                                  : std::numeric_limits<double>::infinity());
  }
  return distances;
}

}  // namespace slamscope::tracking
