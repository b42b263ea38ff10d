// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>

#include "slam/angle.hpp"
#include "tests/slam/variants/square_root.hpp"

namespace slamscope::slam::testing {

/// Unscented Kalman filter on the whole state: 2N + 1 sigma points through the motion and through
/// the observation model (α = 1, β = 2, κ = 0). Process noise is added, new features are
/// initialised by Jacobians.
class UnscentedFilter final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  Eigen::Matrix3d predict(EkfState& state, const Motion& motion) override {
    const Eigen::Matrix3d Q = processNoise(state, motion);
    Eigen::MatrixXd points = sigmaPoints(state);
    for (Eigen::Index k = 0; k < points.cols(); ++k) {
      points.col(k).head<3>() = movePose(points.col(k).head<3>(), motion.increment);
    }
    // Angles are averaged as differences from the middle point.
    const Eigen::VectorXd middle = points.col(points.cols() - 1);
    Eigen::MatrixXd spread = points.colwise() - middle;
    for (Eigen::Index k = 0; k < spread.cols(); ++k) spread(2, k) = wrapAngle(spread(2, k));
    const Eigen::VectorXd shift = mean(spread);
    state.x = middle + shift;
    state.x[2] = wrapAngle(state.x[2]);
    spread.colwise() -= shift;
    state.P = covariance(spread, spread);
    state.P.topLeftCorner<3, 3>() += Q;
    return Q;
  }

  Correction update(EkfState& state, std::span<const Observation> observations) override {
    std::vector<LinearisedObservation> linearised;
    for (const Observation& o : observations) linearised.push_back(linearise(state, o));
    Correction c = correct(state, std::move(linearised));  // for the record, and its sizes
    if (!c.applied) return c;
    const Eigen::MatrixXd points = sigmaPoints(state);
    Eigen::MatrixXd z(c.innovation.size(), points.cols());  // expected minus given reading
    for (Eigen::Index k = 0; k < points.cols(); ++k) {
      EkfState at = state;
      at.x = points.col(k);
      for (std::size_t i = 0; i < observations.size(); ++i) {
        const int row = state.rowOf(observations[i].id).value();
        z.col(k).segment<2>(2 * static_cast<Eigen::Index>(i)) =
            -innovation(at, row, observations[i].z);
      }
    }
    c.innovation = -mean(z);
    z.colwise() += c.innovation;
    const Eigen::MatrixXd spread = points.colwise() - state.x;
    c.S = covariance(z, z) + denseR(c);
    c.L = c.S.llt().matrixL();
    c.Y = covariance(spread, z);
    c.L.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(c.Y);
    updateMean(state, c);
    updateCovariance(state, c);
    return c;
  }

 private:
  /// N×(2N + 1), the middle point last.
  static Eigen::MatrixXd sigmaPoints(const EkfState& state) {
    const Eigen::Index n = state.size();
    const Eigen::MatrixXd root = std::sqrt(static_cast<double>(n)) * squareRoot(wholeP(state));
    Eigen::MatrixXd points(n, 2 * n + 1);
    points << root, -root, Eigen::VectorXd::Zero(n);
    points.colwise() += state.x;
    return points;
  }

  /// The middle point has weight 0 in the mean and β in the covariance.
  static Eigen::VectorXd mean(const Eigen::MatrixXd& points) {
    return points.leftCols(points.cols() - 1).rowwise().mean();
  }

  static Eigen::MatrixXd covariance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    const Eigen::Index outer = a.cols() - 1;
    const Eigen::VectorXd middle_a = a.col(outer);
    const Eigen::VectorXd middle_b = b.col(outer);
    return a.leftCols(outer) * b.leftCols(outer).transpose() / static_cast<double>(outer) +
           2.0 * middle_a * middle_b.transpose();
  }
};

}  // namespace slamscope::slam::testing
