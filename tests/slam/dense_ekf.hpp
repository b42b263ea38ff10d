// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <span>
#include <vector>

#include "slam/angle.hpp"
#include "slam/ekf_equations.hpp"
#include "slam/models.hpp"

namespace slamscope::slam::testing {

/// EKF-SLAM as a textbook prints it: dense Jacobians of the whole state, the full P, an explicit
/// inverse, Joseph's form by choice. Slow, and shares with the filter only the models.
class DenseEkf {
 public:
  DenseEkf(Sensor sensor, const Eigen::Vector3d& pose, const Eigen::Matrix3d& P_vv)
      : x(pose), P(P_vv), sensor_(sensor) {}

  void predict(const Motion& motion) {
    Eigen::Matrix3d F_x;
    Eigen::Matrix3d G_u;
    x.head<3>() = movePose(x.head<3>(), motion.increment, &F_x, &G_u);
    Eigen::MatrixXd F = Eigen::MatrixXd::Identity(x.size(), x.size());
    F.topLeftCorner<3, 3>() = F_x;
    P = (F * P * F.transpose()).eval();
    P.topLeftCorner<3, 3>() += G_u * motion.M * G_u.transpose();
  }

  void update(std::span<const Observation> observations) {
    const auto rows = static_cast<Eigen::Index>(2 * observations.size());
    if (rows == 0) return;
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(rows, x.size());
    Eigen::MatrixXd R = Eigen::MatrixXd::Zero(rows, rows);
    Eigen::VectorXd innovation(rows);
    Eigen::Index k = 0;
    for (const Observation& o : observations) {
      const Eigen::Index f = row(o.id).value();
      const Eigen::Vector2d z = observeFeature(sensor_, x.head<3>(), x.segment<2>(f));
      const auto [H_v, H_f] = observeJacobians(sensor_, x.head<3>(), x.segment<2>(f));
      H.block<2, 3>(k, 0) = heading_sign * H_v;
      H.block<2, 2>(k, f) = H_f;
      R.block<2, 2>(k, k) = o.R;
      innovation.segment<2>(k) = observationDifference(sensor_, o.z, z);
      k += 2;
    }
    const Eigen::MatrixXd S = H * P * H.transpose() + R;
    const Eigen::MatrixXd K = S.llt().solve(H * P).transpose();
    x += K * innovation;
    x[2] = wrapAngle(x[2]);
    P = ((Eigen::MatrixXd::Identity(x.size(), x.size()) - K * H) * P).eval();
  }

  void initialise(const Observation& o) {
    Matrix23d G_v;
    Eigen::Matrix2d G_z;
    const Eigen::Vector2d feature = locateFeature(sensor_, x.head<3>(), o.z, &G_v, &G_z);
    const Eigen::Index n = x.size();
    Eigen::MatrixXd G = Eigen::MatrixXd::Zero(n + 2, n);
    G.topRows(n).setIdentity();
    G.bottomLeftCorner<2, 3>() = G_v;
    P = (G * P * G.transpose()).eval();
    P.bottomRightCorner<2, 2>() += G_z * o.R * G_z.transpose();
    x.conservativeResize(n + 2);
    x.tail<2>() = feature;
    ids.push_back(o.id);
  }

  [[nodiscard]] std::optional<Eigen::Index> row(FeatureId id) const {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      if (ids[k] == id) return static_cast<Eigen::Index>(3 + 2 * k);
    }
    return std::nullopt;
  }

  std::vector<FeatureId> ids;
  Eigen::VectorXd x;
  Eigen::MatrixXd P;
  double heading_sign = 1.0;  ///< −1 spoils H: the must-fail twin

 private:
  Sensor sensor_;
};

}  // namespace slamscope::slam::testing
