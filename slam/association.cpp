// SPDX-License-Identifier: MIT
#include "slam/association.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "slam/audit/chi_square.hpp"
#include "slam/joint_search.hpp"

namespace slamscope::slam {
namespace {

double determinant(const Eigen::Matrix2d& S) {
  return S(0, 0) * S(1, 1) - S(0, 1) * S(1, 0);
}

/// νᵀ S⁻¹ ν in closed form; not a number where S is not positive definite.
double squaredDistance(const Eigen::Vector2d& innovation, const Eigen::Matrix2d& S) {
  if (!(determinant(S) > 0.0) || !(S(0, 0) > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  return (innovation[0] * innovation[0] * S(1, 1) -
          innovation[0] * innovation[1] * (S(0, 1) + S(1, 0)) +
          innovation[1] * innovation[1] * S(0, 0)) /
         determinant(S);
}

/// Each reading goes to its likeliest feature, if nothing else is nearly as likely; where two want
/// the same, the likelier of the two.
void takeNearest(std::vector<Pairing> compatible, double margin, Matches& matches) {
  std::sort(compatible.begin(), compatible.end(),
            [](const Pairing& a, const Pairing& b) { return a.gain > b.gain; });
  std::vector<const Pairing*> nearest(matches.feature.size(), nullptr);
  std::vector<bool> disputed(matches.feature.size(), false);
  for (const Pairing& pairing : compatible) {
    const auto reading = static_cast<std::size_t>(pairing.reading);
    if (nearest[reading] == nullptr) {
      nearest[reading] = &pairing;
      disputed[reading] = pairing.gain < margin;
    } else if (pairing.gain > nearest[reading]->gain - margin) {
      disputed[reading] = true;
    }
  }
  std::vector<bool> taken(matches.hinted.size(), false);
  for (const Pairing& pairing : compatible) {
    const auto reading = static_cast<std::size_t>(pairing.reading);
    const auto feature = static_cast<std::size_t>(pairing.feature);
    if (nearest[reading] != &pairing || taken[feature] || !(pairing.gain > 0.0)) continue;
    taken[feature] = true;
    if (disputed[reading]) continue;
    matches.feature[reading] = pairing.feature;
    matches.gain += pairing.gain;
  }
}

void takeJoint(const JointSearch::Result& found, Matches& matches) {
  for (const Pairing& pairing : found.pairings) {
    matches.feature[static_cast<std::size_t>(pairing.reading)] = pairing.feature;
  }
  matches.gain = found.gain;
  matches.cut_short = found.cut_short;
}

/// H_a P H_bᵀ of two features' readings, from the lower triangle of P.
Eigen::Matrix2d crossCovariance(const EkfState& state, std::span<const ExpectedReading> expected,
                                int a, int b) {
  const ExpectedReading& of_a = expected[static_cast<std::size_t>(a)];
  const ExpectedReading& of_b = expected[static_cast<std::size_t>(b)];
  const int row_a = Snapshot::row(a);
  const int row_b = Snapshot::row(b);
  const Eigen::Matrix3d P_vv = state.P.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>();
  const Matrix23d P_av = state.P.block<2, 3>(row_a, 0);
  const Matrix23d P_bv = state.P.block<2, 3>(row_b, 0);
  const Eigen::Matrix2d P_ab = row_a > row_b
                                   ? Eigen::Matrix2d(state.P.block<2, 2>(row_a, row_b))
                                   : Eigen::Matrix2d(state.P.block<2, 2>(row_b, row_a).transpose());
  return (of_a.H_v * P_vv + of_a.H_f * P_av) * of_b.H_v.transpose() +
         (of_a.H_v * P_bv.transpose() + of_a.H_f * P_ab) * of_b.H_f.transpose();
}

/// A reading near a feature that no other reading is of might be of that one. Near features that
/// are taken it is of something else: a feature gives one reading at a time.
void markAmbiguous(const std::vector<Pairing>& near, double margin, Matches& matches) {
  std::vector<bool> taken(matches.hinted.size(), false);
  for (const int feature : matches.feature) {
    if (feature >= 0) taken[static_cast<std::size_t>(feature)] = true;
  }
  for (const Pairing& pairing : near) {
    const auto feature = static_cast<std::size_t>(pairing.feature);
    matches.hinted[feature] = true;
    int& found = matches.feature[static_cast<std::size_t>(pairing.reading)];
    const bool likely = pairing.gain > -margin;
    if (found == Matches::kFresh && likely && !taken[feature]) found = Matches::kAmbiguous;
  }
}

}  // namespace

std::vector<ExpectedReading> expectedReadings(const EkfState& state, Sensor sensor) {
  std::vector<ExpectedReading> result(state.ids.size());
  const Eigen::Matrix3d P_vv = state.P.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>();
  for (std::size_t k = 0; k < result.size(); ++k) {
    ExpectedReading& e = result[k];
    const int row = Snapshot::row(static_cast<int>(k));
    const Eigen::Vector2d feature = state.x.segment<2>(row);
    e.z = observeFeature(sensor, state.pose(), feature);
    const ObserveJacobians jacobians = observeJacobians(sensor, state.pose(), feature);
    e.H_v = jacobians.H_v;
    e.H_f = jacobians.H_f;
    const Eigen::Matrix2d P_ff = state.P.block<2, 2>(row, row).selfadjointView<Eigen::Lower>();
    const Eigen::Matrix2d cross = e.H_f * state.P.block<2, 3>(row, 0) * e.H_v.transpose();
    e.HPHt = e.H_v * P_vv * e.H_v.transpose() + cross + cross.transpose() +
             e.H_f * P_ff * e.H_f.transpose();
  }
  return result;
}

Associator::Associator(Sensor sensor, Association association, const AssociationGates& gates)
    : sensor_(sensor), association_(association), gates_(gates) {
  if (sensor == Sensor::unknown || association == Association::known) {
    throw std::invalid_argument("an associator needs a sensor, and nearest or joint");
  }
  if (!(gates.pair > 0.0 && gates.pair <= gates.fresh && gates.fresh < 1.0 && gates.odds >= 1.0 &&
        gates.fresh_density > 0.0)) {
    throw std::invalid_argument(
        "association gates must be probabilities, 0 < pair <= fresh < 1, odds 1 at least and the "
        "density of new features above 0; got " +
        std::to_string(gates.pair) + ", " + std::to_string(gates.fresh) + ", " +
        std::to_string(gates.odds) + " and " + std::to_string(gates.fresh_density));
  }
  margin_ = std::log(gates.odds);
  fresh_quantile_ = chiSquareQuantile(1.0 - gates.fresh, 2.0);
  const std::size_t most = association == Association::joint ? JointSearch::kMostReadings : 1;
  for (std::size_t k = 1; k <= most; ++k) {
    pair_quantile_.push_back(chiSquareQuantile(1.0 - gates.pair, 2.0 * static_cast<double>(k)));
  }
}

Matches Associator::match(const EkfState& state, std::span<const ExpectedReading> expected,
                          std::span<const Observation> readings) const {
  Matches matches;
  matches.feature.assign(readings.size(), Matches::kFresh);
  matches.hinted.assign(expected.size(), false);
  std::vector<Pairing> compatible;
  std::vector<Pairing> near;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    // −ln of the density of readings of new features: a strip of the floor is as wide as its range.
    const double width = sensor_ == Sensor::range_bearing ? std::abs(readings[i].z[0]) : 1.0;
    const double bonus = -std::log(2.0 * std::numbers::pi * gates_.fresh_density * width);
    for (std::size_t k = 0; k < expected.size(); ++k) {
      const Eigen::Vector2d innovation =
          observationDifference(sensor_, readings[i].z, expected[k].z);
      const double squared = squaredDistance(innovation, expected[k].HPHt + readings[i].R);
      if (!(squared <= fresh_quantile_)) continue;  // nor where it is not a number
      const double gain =
          bonus - 0.5 * (squared + std::log(determinant(expected[k].HPHt + readings[i].R)));
      const double most = bonus - 0.5 * std::log(determinant(readings[i].R));  // S is R at least
      near.push_back({static_cast<int>(i), static_cast<int>(k), innovation, bonus, gain, most});
      if (squared <= pair_quantile_.front()) compatible.push_back(near.back());
    }
  }
  if (association_ == Association::nearest) {
    takeNearest(std::move(compatible), margin_, matches);
  } else {
    const auto covariance = [&](const Pairing& a, const Pairing& b) -> Eigen::Matrix2d {
      if (a.reading != b.reading) return crossCovariance(state, expected, a.feature, b.feature);
      return expected[static_cast<std::size_t>(a.feature)].HPHt +
             readings[static_cast<std::size_t>(a.reading)].R;
    };
    JointSearch search(covariance, {pair_quantile_, margin_, gates_.search_limit});
    takeJoint(search.run(std::move(compatible)), matches);
  }
  markAmbiguous(near, margin_, matches);
  return matches;
}

}  // namespace slamscope::slam
