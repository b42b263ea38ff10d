// SPDX-License-Identifier: MIT
#include "slam/audit/law_finite.hpp"

#include <cmath>
#include <limits>

namespace slamscope::slam {
namespace {

/// 0 · x is 0 for finite x only; a sum vectorises where a test of each does not.
bool allFinite(std::span<const double> numbers) {
  const Eigen::Map<const Eigen::ArrayXd> values(numbers.data(),
                                                static_cast<Eigen::Index>(numbers.size()));
  return (values * 0.0).sum() == 0.0;
}

bool rowFinite(const Snapshot& snapshot, int row) {
  return std::isfinite(snapshot.covariance(row, row)) &&
         std::isfinite(snapshot.covariance(row, 0)) && std::isfinite(snapshot.covariance(row, 1)) &&
         std::isfinite(snapshot.covariance(row, 2));
}

}  // namespace

Outcome checkFinite(const Snapshot& snapshot, bool means_known, bool covariance_finite) {
  bool pose = true;
  std::vector<FeatureId> bad;
  if (means_known) {
    pose = snapshot.pose.allFinite();
    for (std::size_t k = 0; k < snapshot.features.size(); ++k) {
      if (!snapshot.features[k].allFinite()) bad.push_back(snapshot.ids[k]);
    }
  }
  const bool covariance = covariance_finite || allFinite(snapshot.covariance.packed());
  if (pose && bad.empty() && covariance) return Outcome::of(0.0, 0.0);
  Outcome outcome = Outcome::of(std::numeric_limits<double>::infinity(), 0.0);
  for (int i = 0; i < snapshot.featureCount() && bad.empty() && pose; ++i) {
    const int row = Snapshot::row(i);
    if (rowFinite(snapshot, row) && rowFinite(snapshot, row + 1)) continue;
    bad.push_back(snapshot.ids[static_cast<std::size_t>(i)]);
  }
  // All or most of the map: the state as a whole.
  if (2 * bad.size() <= snapshot.ids.size()) {
    for (const FeatureId id : bad)
      outcome.blame.push_back({id, 1.0 / static_cast<double>(bad.size())});
  }
  outcome.amount = !pose         ? "the pose is not a finite number"
                   : !covariance ? "the covariance holds a number that is not finite"
                                 : "a feature's mean is not a finite number";
  return outcome;
}

}  // namespace slamscope::slam
