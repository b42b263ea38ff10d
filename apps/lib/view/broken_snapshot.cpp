// SPDX-License-Identifier: MIT
#include "apps/lib/view/broken_snapshot.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace slamscope::apps {
namespace {

constexpr double kFarAway = 1e6;      // m
constexpr double kAsymmetry = 1e-4;   // of the largest variance; float32 logs show 1e-7
constexpr double kIndefinite = 1e-5;  // of the scaled matrix; 6-digit logs round by 1e-6

bool indefinite(Eigen::MatrixXd P) {
  // Scaled by √diag, and lifted by what rounding may have taken.
  const Eigen::VectorXd scale =
      P.diagonal().unaryExpr([](double v) { return v > 0.0 ? 1.0 / std::sqrt(v) : 0.0; });
  P = scale.asDiagonal() * P * scale.asDiagonal();
  P.diagonal().array() += kIndefinite * static_cast<double>(P.rows());
  return Eigen::LLT<Eigen::MatrixXd>(P).info() != Eigen::Success;
}

}  // namespace

std::optional<std::string> brokenness(const slam::Snapshot& snapshot) {
  if (!snapshot.finite()) return "a number is not finite";
  if (snapshot.pose.head<2>().norm() > kFarAway) return "the pose is beyond 1e6 m";
  const slam::PackedCovariance& P = snapshot.covariance;
  double largest = 0.0;
  for (int k = 0; k < P.size(); ++k) {
    if (P(k, k) < 0.0) return "variance " + std::to_string(k) + " is negative";
    largest = std::max(largest, P(k, k));
  }
  if (snapshot.asymmetry.value_or(0.0) > kAsymmetry * largest)
    return "the covariance is asymmetric";
  if (snapshot.diagonal_only) return std::nullopt;
  if (P.size() <= kLargestFactored) {
    if (indefinite(P.dense())) return "the covariance is indefinite";
    return std::nullopt;
  }
  for (int k = 0; k < snapshot.featureCount(); ++k) {
    const int row = slam::Snapshot::row(k);
    if (indefinite(P.block2(row, row))) {
      return "the covariance of feature " +
             std::to_string(snapshot.ids[static_cast<std::size_t>(k)]) + " is indefinite";
    }
  }
  return std::nullopt;
}

}  // namespace slamscope::apps
