// SPDX-License-Identifier: MIT
#include "slam/audit/law_sensor_noise.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slam/models.hpp"

namespace slamscope::slam {
namespace {

double difference(const Eigen::Matrix2d& R, const Eigen::Matrix2d& other) {
  const Eigen::Vector2d scale = other.diagonal().cwiseSqrt().cwiseInverse();
  return (scale.asDiagonal() * (R - other) * scale.asDiagonal()).cwiseAbs().maxCoeff();
}

std::vector<std::string_view> patternsOf(const Eigen::Matrix2d& R, const Eigen::Matrix2d& declared,
                                         Sensor sensor, double tolerance) {
  std::vector<std::string_view> patterns;
  const double loose = std::max(0.02, 2.0 * tolerance);
  const auto is = [&](const Eigen::Matrix2d& other) { return difference(R, other) < loose; };
  if (is(declared.diagonal().cwiseSqrt().asDiagonal().toDenseMatrix())) {
    patterns.emplace_back("noise-sigma");
  }
  const double degrees = 180.0 / std::numbers::pi;
  const Eigen::Vector2d in_degrees(1.0, degrees);
  if (sensor == Sensor::range_bearing &&
      is(in_degrees.asDiagonal() * declared * in_degrees.asDiagonal())) {
    patterns.emplace_back("noise-degrees");
  }
  const double factor = R.trace() / declared.trace();
  if (std::abs(factor - 0.5) < 0.1 && difference(R, 0.5 * declared) < 0.15) {
    patterns.emplace_back("observed-twice");
  } else if (factor > 0.0 && is(factor * declared)) {
    patterns.emplace_back("noise-factor");
  }
  return patterns;
}

}  // namespace

Outcome checkSensorNoise(const Transition& t, const UpdateAnatomy& anatomy,
                         const InnovationEstimate& estimate, Sensor sensor,
                         const Eigen::Matrix2d& R) {
  if (sensor == Sensor::unknown) return Outcome::notCheckable("the sensor is not declared");
  const bool nearly = !anatomy.fit.whole;
  if (nearly && !anatomy.nearly) return {};
  Outcome worst = Outcome::notCheckable("R drowns in the change of P");
  for (std::size_t k = 0; k < estimate.features.size(); ++k) {
    const FeatureInnovation& f = estimate.features[k];
    const double tolerance = (nearly ? 0.2 : 1e-4) + 4.0 * f.R_error;
    if (!f.R_map.allFinite() || tolerance > 0.3) continue;
    Eigen::Vector3d pose = t.before->pose;
    const Eigen::Vector2d l = pose.head<2>() + anatomy.deltas[k];
    Eigen::Matrix2d A;
    observeFeature(sensor, pose, l, nullptr, &A);
    if (!A.allFinite()) continue;
    const Eigen::Matrix2d R_used = A * f.R_map * A.transpose();
    Outcome one = Outcome::of(difference(R_used, R), tolerance);
    if (worst.checked() && one.residual / one.tolerance <= worst.residual / worst.tolerance)
      continue;
    if (one.violated()) {
      one.patterns = patternsOf(R_used, R, sensor, tolerance);
      one.amount = "the noise of an observation is not the declared R";
      one.evidence = {{"R(1,1)", R_used(0, 0), R(0, 0)}, {"R(2,2)", R_used(1, 1), R(1, 1)}};
    }
    worst = one;
  }
  return worst;
}

}  // namespace slamscope::slam
