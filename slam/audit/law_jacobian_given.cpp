// SPDX-License-Identifier: MIT
#include "slam/audit/law_jacobian_given.hpp"

#include <algorithm>
#include <cmath>

#include "slam/models.hpp"

namespace slamscope::slam {
namespace {

Eigen::MatrixXd numeric(Sensor sensor, const Eigen::Vector3d& pose, const Eigen::Vector2d& feature,
                        int row, Eigen::Index size) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2, size);
  const auto column = [&](const Eigen::Vector3d& d_pose, const Eigen::Vector2d& d_feature) {
    constexpr double kStep = 1e-5;
    const Eigen::Vector2d plus =
        observeFeature(sensor, pose + kStep * d_pose, feature + kStep * d_feature);
    const Eigen::Vector2d minus =
        observeFeature(sensor, pose - kStep * d_pose, feature - kStep * d_feature);
    return Eigen::Vector2d(observationDifference(sensor, plus, minus) / (2.0 * kStep));
  };
  for (int k = 0; k < 3; ++k) {
    H.col(k) = column(Eigen::Vector3d::Unit(k), Eigen::Vector2d::Zero());
  }
  for (int k = 0; k < 2; ++k) {
    H.col(row + k) = column(Eigen::Vector3d::Zero(), Eigen::Vector2d::Unit(k));
  }
  return H;
}

void showWorst(const Eigen::MatrixXd& given, const Eigen::MatrixXd& lawful, Outcome& outcome) {
  Eigen::Index r = 0;
  Eigen::Index c = 0;
  (given - lawful).cwiseAbs().maxCoeff(&r, &c);
  outcome.evidence.clear();
  outcome.show("H(" + std::to_string(r + 1) + "," + std::to_string(c + 1) + ")", given(r, c),
               lawful(r, c));
}

}  // namespace

Outcome checkJacobianGiven(const Transition& t, const LinearisationPoints& points, Sensor sensor) {
  Outcome worst;
  for (const ObservationRecord& o : t.after->observations) {
    if (o.H.size() == 0) continue;
    if (sensor == Sensor::unknown) return Outcome::notCheckable("the sensor is not declared");
    const std::optional<int> index = t.before->indexOf(o.id);
    if (!index || o.H.rows() != 2 || o.H.cols() < Snapshot::row(*index) + 2) continue;
    const int row = Snapshot::row(*index);
    const Eigen::Vector2d l = t.before->features[static_cast<std::size_t>(*index)];
    const Eigen::MatrixXd lawful = numeric(sensor, t.before->pose, l, row, o.H.cols());
    const double size = lawful.cwiseAbs().maxCoeff();
    double off = (o.H - lawful).cwiseAbs().maxCoeff() / size;
    const double tolerance = 1e-5 + (t.rounded ? 1e-3 : 0.0);
    if (off > tolerance && points.after_prediction) {
      const std::optional<Eigen::Vector2d> then = points.after_prediction->feature(o.id);
      if (then) {
        const Eigen::MatrixXd frozen =
            numeric(sensor, points.after_prediction->pose, *then, row, o.H.cols());
        off = std::min(off, (o.H - frozen).cwiseAbs().maxCoeff() / size);
      }
    }
    if (worst.checked() && off <= worst.residual) continue;
    worst = Outcome::of(off, tolerance);
    if (!worst.violated()) continue;
    worst.amount = "the given H is not the derivative of the observation";
    worst.blame = {{o.id, 1.0}};
    showWorst(o.H, lawful, worst);
    if (off < 0.05) {  // near: an iterated or first-estimates Jacobian
      worst = Outcome::notCheckable("H taken near the mean, not at it");
    }
  }
  return worst;
}

}  // namespace slamscope::slam
