// SPDX-License-Identifier: MIT
#include "slam/audit/law_sensor_noise.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "slam/correlation.hpp"
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
  // Used twice, linearised a little differently: half of R in one direction, up to R in the other.
  const Eigen::Vector2d scale = declared.diagonal().cwiseSqrt().cwiseInverse();
  const PrincipalAxes axes = principalAxes(scale.asDiagonal() * R * scale.asDiagonal());
  if (std::abs(axes.eigenvalues[1] - 0.5) < 0.1 && axes.eigenvalues[0] < 1.1) {
    patterns.emplace_back("observed-twice");
  } else if (factor > 0.0 && std::abs(factor - 1.0) > 0.1 && is(factor * declared)) {
    patterns.emplace_back("noise-factor");
  }
  return patterns;
}

/// R of the observation of that feature, where the record has it.
std::optional<Eigen::Matrix2d> noiseGivenFor(FeatureId id, const Snapshot& snapshot) {
  for (const ObservationRecord& o : snapshot.observations) {
    if (o.id == id && !o.R.isZero(0.0)) return o.R;
  }
  return std::nullopt;
}

}  // namespace

Outcome checkSensorNoise(const Transition& t, const UpdateAnatomy& anatomy,
                         const InnovationEstimate& estimate, const RunHeader& header) {
  const Sensor sensor = header.sensor;
  if (sensor == Sensor::unknown) return Outcome::notCheckable("the sensor is not declared");
  if (!anatomy.fit.whole && !anatomy.heading_besides) return {};
  // Frozen linearisation: A would have to be taken at the heading of then.
  if (anatomy.allow == "frozen-linearisation" && sensor == Sensor::relative_position) return {};
  Outcome worst = Outcome::notCheckable("R drowns in the change of P");
  for (std::size_t k = 0; k < estimate.features.size(); ++k) {
    const FeatureInnovation& f = estimate.features[k];
    // Seen twice in one update, say by two readings: R̂ is that of both together.
    const auto& seen = t.after->observed;
    if (std::count(seen.begin(), seen.end(), f.id) > 1) continue;
    const double tolerance = (anatomy.heading_besides ? 0.05 : 1e-4) + 4.0 * f.R_error;
    if (!f.R_map.allFinite() || tolerance > 0.3) continue;
    const std::optional<Eigen::Matrix2d> declared =
        header.R ? header.R : noiseGivenFor(f.id, *t.after);
    if (!declared) continue;
    const Eigen::Matrix2d& R = *declared;
    Eigen::Vector3d pose = t.before->pose;
    const Eigen::Vector2d l = pose.head<2>() + anatomy.deltas[k];
    const Eigen::Matrix2d A = observeJacobians(sensor, pose, l).H_f;
    if (!A.allFinite()) continue;
    const Eigen::Matrix2d R_used = A * f.R_map * A.transpose();
    Outcome one = Outcome::of(difference(R_used, R), tolerance);
    if (worst.checked() && one.residual / one.tolerance <= worst.residual / worst.tolerance)
      continue;
    if (one.violated()) {
      one.patterns = patternsOf(R_used, R, sensor, tolerance);
      one.amount = "the noise of an observation is not the declared R";
      one.show("R(1,1)", R_used(0, 0), R(0, 0));
      one.show("R(2,2)", R_used(1, 1), R(1, 1));
    }
    worst = one;
  }
  return worst;
}

}  // namespace slamscope::slam
