// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace slamscope::slam {

/// Tells features from padding in states whose size is fixed, where nobody wrote ids.
///
/// The rule: a place of the state holds *no feature* in a step where its mean and all of its rows
/// and columns of P are NaN (or all are zero: people preallocate with zeros too). Anything else is
/// a feature, and a NaN among its numbers is a finding for the audit. So is a NaN everywhere in a
/// step whose pose is NaN too: that is a filter that diverged, not one without features. A feature
/// that turns into padding beside a sound pose was removed, which needs ids to be told from others
/// that moved up: unreadable.
class FeaturePlaces {
 public:
  /// The places (0, 1, …) that hold a feature. `x`: 3 + 2n numbers, or none where means are
  /// unknown; `P`: N×N numbers row by row, or N (its diagonal). Throws std::runtime_error "ids: …".
  [[nodiscard]] std::vector<int> find(std::span<const double> x, std::span<const double> P,
                                      std::size_t size);

 private:
  std::vector<bool> seen_;  ///< places that held a feature in an earlier step
};

/// A place without a feature, by the rule above.
[[nodiscard]] bool isPadding(std::span<const double> x, std::span<const double> P, std::size_t size,
                             int place);

}  // namespace slamscope::slam
