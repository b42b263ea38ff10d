// SPDX-License-Identifier: MIT
#include "slam/audit/innovation_estimate.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace slamscope::slam {
namespace {

/// D⁺ over the eigenvectors whose eigenvalues stand out of the noise.
struct PseudoInverse {
  Eigen::MatrixXd half;  ///< D⁺ = half halfᵀ
  double least = 0.0;    ///< least eigenvalue kept, or a bound below it
};

PseudoInverse pseudoInverse(const Transition& t, const Eigen::MatrixXd& D) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(D);
  const Eigen::VectorXd& values = eigen.eigenvalues();
  const double floor = leastResolved(t, D.rows(), values.cwiseAbs().maxCoeff());
  PseudoInverse inverse;
  Eigen::Index first = 0;
  while (first < values.size() && !(values[first] > floor)) ++first;
  const Eigen::Index count = values.size() - first;
  inverse.half = eigen.eigenvectors().rightCols(count) *
                 values.tail(count).cwiseSqrt().cwiseInverse().asDiagonal();
  if (count > 0) inverse.least = values[first];
  return inverse;
}

Eigen::VectorXd pick(const Eigen::VectorXd& v, const std::vector<int>& states) {
  Eigen::VectorXd picked(static_cast<Eigen::Index>(states.size()));
  for (std::size_t k = 0; k < states.size(); ++k) {
    picked[static_cast<Eigen::Index>(k)] = v[states[k]];
  }
  return picked;
}

/// B_i P⁻ B_iᵀ from U_i = P⁻ B_iᵀ.
Eigen::Matrix2d projected(const Transition& t, const Eigen::MatrixXd& U, Eigen::Index column,
                          int feature, const Eigen::Vector2d& delta) {
  const auto row = [&](int state) {
    return Eigen::RowVector2d(U.block<1, 2>(state, column) * t.sigma[state]);
  };
  const int l = Snapshot::row(feature);
  Eigen::Matrix2d result;
  result.row(0) = row(l) - row(0) + delta.y() * row(2);
  result.row(1) = row(l + 1) - row(1) - delta.x() * row(2);
  return result;
}

/// S̃ − B̃ P⁻ B̃ᵀ is the noise of the observations and of the heading together; `cross` is the
/// column of S̃ where heading and feature meet, `variance` its entry for the heading.
double headingCorrelation(const Transition& t, const FeatureInnovation& one, int feature,
                          const Eigen::Vector2d& delta, const Eigen::Vector2d& cross,
                          double variance) {
  const PackedCovariance& P = t.before->covariance;
  const int l = Snapshot::row(feature);
  const Eigen::Vector2d believed(P(l, 2) - P(0, 2) + delta.y() * P(2, 2),
                                 P(l + 1, 2) - P(1, 2) - delta.x() * P(2, 2));
  const Eigen::Vector2d noise = cross - believed;
  const double heading = variance - P(2, 2);
  const Eigen::LLT<Eigen::Matrix2d> R(one.R_map);
  if (!(heading > 1e-6 * variance) || R.info() != Eigen::Success || one.R_error > 0.1) return 0.0;
  return std::sqrt(noise.dot(R.solve(noise)) / heading);
}

}  // namespace

double leastResolved(const Transition& t, Eigen::Index rows, double largest) {
  const double size = std::sqrt(static_cast<double>(rows));
  const double mean_noise = 2.0 * t.mean_noise * t.largest_scale;
  return std::max({100.0 * t.noise * size, 1e-9 * largest, 100.0 * mean_noise * mean_noise});
}

double noiseError(const Transition& t, double least, const Eigen::Matrix2d& S,
                  const Eigen::Matrix2d& R_map) {
  return (1e-7 + 50.0 * t.noise / least) * S.trace() / std::max(std::abs(R_map.trace()), 1e-300);
}

InnovationEstimate estimateInnovation(const Transition& t, const UpdateAnatomy& anatomy) {
  InnovationEstimate estimate;
  if (anatomy.observed.empty()) return estimate;
  std::vector<int> blocks{-1};
  for (const int i : anatomy.observed) {
    const bool bad =
        std::find(anatomy.outside.begin(), anatomy.outside.end(), i) != anatomy.outside.end();
    if (!bad) blocks.push_back(i);
  }
  const bool robot_bad =
      std::find(anatomy.outside.begin(), anatomy.outside.end(), -1) != anatomy.outside.end();
  if (robot_bad) blocks.erase(blocks.begin());
  const std::vector<int> states = statesOf(blocks);
  if (states.empty()) return estimate;
  const Eigen::MatrixXd D = t.scaledBlock(states);
  const PseudoInverse inverse = pseudoInverse(t, D);
  const Eigen::VectorXd dx = pick(t.scale.cwiseProduct(t.meanChange()), states);
  const Eigen::VectorXd w = inverse.half.transpose() * dx;
  const Eigen::Index lawful =
      2 * static_cast<Eigen::Index>(anatomy.observed.size()) + (anatomy.heading_besides ? 1 : 0);
  estimate.dof = static_cast<int>(w.size());
  estimate.nis = w.squaredNorm();
  const bool known = anatomy.basis.W.cols() + (anatomy.heading_besides ? 1 : 0) == lawful;
  if (estimate.dof != lawful || !anatomy.outside.empty() || !known) return estimate;
  Eigen::MatrixXd U(static_cast<Eigen::Index>(states.size()), lawful);
  const Eigen::VectorXd heading = t.scaledColumn(2);
  for (std::size_t k = 0; k < states.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    U.row(row).head(anatomy.basis.W.cols()) = anatomy.basis.W.row(states[k]);
    if (anatomy.heading_besides) U(row, lawful - 1) = heading[states[k]];
  }
  const Eigen::MatrixXd V = inverse.half.transpose() * U;
  const Eigen::VectorXd innovation = V.transpose() * w;
  const Eigen::MatrixXd S = V.transpose() * V;
  for (std::size_t k = 0; k < anatomy.observed.size(); ++k) {
    const auto column = 2 * static_cast<Eigen::Index>(k);
    FeatureInnovation one;
    one.id = t.id(anatomy.observed[k]);
    const Eigen::Matrix2d S_i = S.block<2, 2>(column, column);
    const Eigen::Vector2d nu = innovation.segment<2>(column);
    one.nis = nu.dot(S_i.inverse() * nu);
    one.dof = 2;
    one.R_map = S_i - projected(t, anatomy.basis.W, column, anatomy.observed[k], anatomy.deltas[k]);
    one.R_error = noiseError(t, inverse.least, S_i, one.R_map);
    if (anatomy.heading_besides) {
      const double correlation =
          headingCorrelation(t, one, anatomy.observed[k], anatomy.deltas[k],
                             S.block<2, 1>(column, lawful - 1), S(lawful - 1, lawful - 1));
      estimate.heading_correlation = std::max(estimate.heading_correlation, correlation);
    }
    estimate.features.push_back(one);
  }
  return estimate;
}

InnovationEstimate estimateStepInnovation(const Transition& t) {
  InnovationEstimate estimate;
  std::vector<int> features = t.observed;
  if (!t.observed_given) {
    std::vector<std::pair<double, int>> corrected;
    for (int i = 0; i < t.shared; ++i) {
      const int r = Snapshot::row(i);
      corrected.emplace_back(-(t.change(r, r) + t.change(r + 1, r + 1)), i);
    }
    const auto count = std::min<std::ptrdiff_t>(8, static_cast<std::ptrdiff_t>(corrected.size()));
    std::partial_sort(corrected.begin(), corrected.begin() + count, corrected.end());
    for (std::ptrdiff_t k = 0; k < count; ++k) {
      features.push_back(corrected[static_cast<std::size_t>(k)].second);
    }
    std::sort(features.begin(), features.end());
  }
  if (features.empty()) return estimate;
  const Eigen::VectorXd dx = t.scale.cwiseProduct(t.meanChange());
  const std::vector<int> states = statesOf(features);
  const PseudoInverse all = pseudoInverse(t, t.scaledBlock(states));
  estimate.dof = static_cast<int>(all.half.cols());
  estimate.nis = (all.half.transpose() * pick(dx, states)).squaredNorm();
  for (const int i : features) {
    const std::vector<int> own = statesOf({i});
    const PseudoInverse inverse = pseudoInverse(t, t.scaledBlock(own));
    FeatureInnovation one;
    one.id = t.id(i);
    one.dof = static_cast<int>(inverse.half.cols());
    one.nis = (inverse.half.transpose() * pick(dx, own)).squaredNorm();
    estimate.features.push_back(one);
  }
  return estimate;
}

}  // namespace slamscope::slam
