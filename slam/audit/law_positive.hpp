// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "slam/audit/outcome.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// What the least eigenvalue of so many rows of P, scaled by √diag, may fall below zero by.
[[nodiscard]] inline double positiveTolerance(double noise, std::size_t rows) {
  return 1e-8 + 4.0 * noise * std::sqrt(static_cast<double>(rows));
}

/// positive: P ⪰ 0 after scaling by √diag, diagonal ≥ 0. A covariance, by definition; may be
/// singular (start pose exactly known). Tolerance on the least eigenvalue: 1e-8 + 4 noise √N.
///
/// In every record: the diagonal and the block of robot and observed features; where P⁻ was whole
/// and the update keeps `support`, P⁺ ⪰ 0 follows from that block. All of P by a Cholesky
/// factorisation as often as amortises to O(N²) a record, and at the end of the run; seldom where
/// other laws look after what changes.
class PositiveLaw {
 public:
  enum class Looking { often, seldom };

  /// `observed`: places of features, may be empty. `noise`: of a scaled entry.
  [[nodiscard]] Outcome check(const Snapshot& snapshot, const std::vector<int>& observed,
                              double noise, Looking looking);
  /// The same where diagonal and block were found positive already.
  [[nodiscard]] Outcome confirm(const Snapshot& snapshot, double noise);
  /// All of P at once.
  [[nodiscard]] static Outcome checkAll(const Snapshot& snapshot, double noise);

 private:
  bool allIsDue(const Snapshot& snapshot, Looking looking);

  double budget_ = 0.0;  ///< operations saved up for the next factorisation
};

}  // namespace slamscope::slam
