// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "slam/angle.hpp"
#include "slam/ekf_equations.hpp"

namespace slamscope::slam::bench {

/// As textbooks print it: one observation after the other, dense H, the whole of P.
class Textbook {
 public:
  explicit Textbook(const std::vector<Observation>& first) {
    const auto size = static_cast<Eigen::Index>(3 + 2 * first.size());
    x_ = Eigen::VectorXd::Zero(size);
    P_ = Eigen::MatrixXd::Identity(size, size) * 0.01;
    for (const Observation& o : first) {
      x_.segment<2>(row(o)) = locateFeature(Sensor::range_bearing, x_.head<3>(), o.z);
    }
  }

  void step(const Motion& motion, const std::vector<Observation>& readings) {
    Eigen::Matrix3d F;
    Eigen::Matrix3d G;
    x_.head<3>() = movePose(x_.head<3>(), motion.increment, &F, &G);
    P_.topRows(3) = (F * P_.topRows(3)).eval();
    P_.leftCols(3) = (P_.leftCols(3) * F.transpose()).eval();
    P_.topLeftCorner(3, 3) += G * motion.M * G.transpose();
    for (const Observation& o : readings) update(o);
  }

 private:
  static Eigen::Index row(const Observation& o) { return 3 + 2 * static_cast<Eigen::Index>(o.id); }

  void update(const Observation& o) {
    const Eigen::Vector3d pose = x_.head<3>();
    const Eigen::Vector2d feature = x_.segment<2>(row(o));
    const Eigen::Vector2d z = observeFeature(Sensor::range_bearing, pose, feature);
    const auto [H_v, H_f] = observeJacobians(Sensor::range_bearing, pose, feature);
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2, x_.size());
    H.leftCols(3) = H_v;
    H.middleCols(row(o), 2) = H_f;
    const Eigen::MatrixXd PHt = P_ * H.transpose();
    const Eigen::Matrix2d S = H * PHt + o.R;
    const Eigen::MatrixXd K = PHt * S.inverse();
    x_ += K * observationDifference(Sensor::range_bearing, o.z, z);
    x_[2] = wrapAngle(x_[2]);
    P_ -= K * PHt.transpose();
  }

  Eigen::VectorXd x_;
  Eigen::MatrixXd P_;
};

}  // namespace slamscope::slam::bench
