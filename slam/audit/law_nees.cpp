// SPDX-License-Identifier: MIT
#include "slam/audit/law_nees.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "slam/angle.hpp"
#include "slam/audit/chi_square.hpp"

namespace slamscope::slam {
namespace {

struct Nees {
  double value = 0.0;
  int dof = 0;
};

/// eᵀ P⁺ e over the directions in which P is not zero.
Nees neesOf(const Eigen::MatrixXd& P, const Eigen::VectorXd& error) {
  const Eigen::VectorXd scale = P.diagonal().unaryExpr(
      [](double variance) { return variance > 1e-200 ? 1.0 / std::sqrt(variance) : 0.0; });
  const Eigen::MatrixXd correlation = scale.asDiagonal() * P * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation);
  const Eigen::VectorXd along = eigen.eigenvectors().transpose() * scale.cwiseProduct(error);
  Nees nees;
  for (Eigen::Index k = 0; k < along.size(); ++k) {
    if (!(eigen.eigenvalues()[k] > 1e-6)) continue;
    nees.value += along[k] * along[k] / eigen.eigenvalues()[k];
    ++nees.dof;
  }
  return nees;
}

}  // namespace

Outcome checkNees(const Snapshot& snapshot, double alpha) {
  if (!snapshot.truth) return Outcome::notCheckable("no truth");
  if (!snapshot.finite() || !snapshot.truth->pose.allFinite()) return {};
  constexpr double kGranted = 2.0;
  const double share = alpha / (1.0 + snapshot.featureCount());
  Outcome outcome = Outcome::of(0.0, 1.0);
  const auto judge = [&](const Nees& nees, const std::string& what, const FeatureId* id) {
    if (nees.dof == 0) return;
    const double bound = kGranted * chiSquareQuantile(share, nees.dof);
    if (nees.value > bound && id != nullptr) outcome.blame.push_back({*id, nees.value});
    if (nees.value / bound <= outcome.residual) return;
    outcome.residual = nees.value / bound;
    outcome.evidence.clear();
    outcome.show("NEES of " + what, nees.value, bound, LawfulIs::at_most);
  };
  Eigen::Vector3d error = snapshot.pose - snapshot.truth->pose;
  error[2] = wrapAngle(error[2]);
  judge(neesOf(snapshot.poseCovariance(), error), "the pose", nullptr);
  for (std::size_t k = 0; k < snapshot.truth->ids.size(); ++k) {
    const FeatureId id = snapshot.truth->ids[k];
    const std::optional<int> index = snapshot.indexOf(id);
    if (!index) continue;
    const int row = Snapshot::row(*index);
    const Eigen::Vector2d off =
        snapshot.features[static_cast<std::size_t>(*index)] - snapshot.truth->features[k];
    judge(neesOf(snapshot.covariance.block2(row, row), off), "feature " + std::to_string(id), &id);
  }
  if (!outcome.violated()) {
    outcome.evidence.clear();
    return outcome;
  }
  double total = 0.0;
  for (const Blame& b : outcome.blame) total += b.share;
  for (Blame& b : outcome.blame) b.share /= total;
  if (2 * outcome.blame.size() > snapshot.ids.size()) outcome.blame.clear();
  outcome.amount = "the error against the truth is larger than the filter believes";
  return outcome;
}

}  // namespace slamscope::slam
