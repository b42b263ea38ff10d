// SPDX-License-Identifier: MIT
#include "slam/audit/law_positive.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace slamscope::slam {
namespace {

Eigen::MatrixXd scaledBlock(const Snapshot& snapshot, const std::vector<int>& states) {
  const auto size = static_cast<Eigen::Index>(states.size());
  Eigen::VectorXd scale(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const int s = states[static_cast<std::size_t>(i)];
    const double variance = snapshot.covariance(s, s);
    scale[i] = variance > 1e-200 ? 1.0 / std::sqrt(variance) : 0.0;
  }
  Eigen::MatrixXd block(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      block(i, j) = block(j, i) = snapshot.covariance(states[static_cast<std::size_t>(i)],
                                                      states[static_cast<std::size_t>(j)]) *
                                  scale[i] * scale[j];
    }
  }
  return block;
}

/// Least eigenvalue and its vector by power iteration on (c − M), c ≥ the largest eigenvalue.
std::pair<double, Eigen::VectorXd> leastEigen(const Eigen::MatrixXd& M) {
  if (M.rows() <= 200) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(M);
    return {eigen.eigenvalues()[0], eigen.eigenvectors().col(0)};
  }
  const double c = M.cwiseAbs().rowwise().sum().maxCoeff();
  Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(M.rows(), 1.0, 2.0).normalized();
  for (int k = 0; k < 60; ++k) v = (c * v - M * v).normalized();
  return {v.dot(M * v), v};
}

Outcome judged(const Snapshot& snapshot, const std::vector<int>& states, double noise) {
  const Eigen::MatrixXd block = scaledBlock(snapshot, states);
  const double tolerance = positiveTolerance(noise, states.size());
  Eigen::MatrixXd shifted = block;
  shifted.diagonal().array() += tolerance;
  const Eigen::LLT<Eigen::MatrixXd> factor(shifted);
  if (factor.info() == Eigen::Success) return Outcome::of(0.0, tolerance);
  const auto [least, vector] = leastEigen(block);
  Outcome outcome = Outcome::of(std::max(-least, 2.0 * tolerance), tolerance);
  std::vector<std::pair<double, FeatureId>> weights;
  double total = 0.0;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const double w = vector[static_cast<Eigen::Index>(k)] * vector[static_cast<Eigen::Index>(k)];
    const int feature = (states[k] - 3) / 2;
    if (states[k] < 3 || feature >= snapshot.featureCount()) continue;
    const FeatureId id = snapshot.ids[static_cast<std::size_t>(feature)];
    total += w;
    if (!weights.empty() && weights.back().second == id) {
      weights.back().first += w;
    } else {
      weights.emplace_back(w, id);
    }
  }
  for (const auto& [w, id] : weights) {
    if (w > 0.1 * total && total > 0.0) outcome.blame.push_back({id, w / total});
  }
  outcome.amount = "P has a negative eigenvalue, " + std::to_string(least) + " after scaling";
  outcome.show("least eigenvalue of P, scaled", least, 0.0, LawfulIs::at_least);
  return outcome;
}

Outcome diagonal(const Snapshot& snapshot) {
  for (int i = 0; i < snapshot.covariance.size(); ++i) {
    const double variance = snapshot.covariance(i, i);
    if (variance >= 0.0) continue;
    Outcome outcome = Outcome::of(1.0, 0.0);
    const int feature = (i - 3) / 2;
    if (i >= 3 && feature < snapshot.featureCount()) {
      outcome.blame.push_back({snapshot.ids[static_cast<std::size_t>(feature)], 1.0});
    }
    outcome.amount = "a variance is negative";
    outcome.show("P(" + std::to_string(i + 1) + "," + std::to_string(i + 1) + ")", variance, 0.0);
    return outcome;
  }
  return Outcome::of(0.0, 0.0);
}

}  // namespace

Outcome PositiveLaw::checkAll(const Snapshot& snapshot, double noise) {
  Outcome outcome = diagonal(snapshot);
  if (outcome.violated() || snapshot.diagonal_only) return outcome;
  std::vector<int> states(static_cast<std::size_t>(snapshot.covariance.size()));
  std::iota(states.begin(), states.end(), 0);
  return judged(snapshot, states, noise);
}

bool PositiveLaw::allIsDue(const Snapshot& snapshot, Looking looking) {
  const double size = snapshot.covariance.size();
  budget_ += (looking == Looking::often ? 4.0 : 0.25) * size * size;
  if (budget_ < size * size * size / 3.0) return false;
  budget_ = 0.0;
  return true;
}

Outcome PositiveLaw::check(const Snapshot& snapshot, const std::vector<int>& observed, double noise,
                           Looking looking) {
  Outcome outcome = diagonal(snapshot);
  if (outcome.violated() || snapshot.diagonal_only) return outcome;
  if (allIsDue(snapshot, looking)) return checkAll(snapshot, noise);
  std::vector<int> states{0, 1, 2};
  for (const int i : observed) {
    states.push_back(Snapshot::row(i));
    states.push_back(Snapshot::row(i) + 1);
  }
  return judged(snapshot, states, noise);
}

Outcome PositiveLaw::confirm(const Snapshot& snapshot, double noise) {
  if (allIsDue(snapshot, Looking::seldom)) return checkAll(snapshot, noise);
  return Outcome::of(0.0, positiveTolerance(noise, 3));
}

}  // namespace slamscope::slam
