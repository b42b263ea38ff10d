// SPDX-License-Identifier: MIT
#pragma once

#include "slam/audit/outcome.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// finite: every mean and every entry of P is a finite number. No tolerance. From LC and L0 on.
/// Blames the features with such a number in their mean or in their rows of P.
/// `covariance_finite`: P is known to be, without looking.
[[nodiscard]] Outcome checkFinite(const Snapshot& snapshot, bool means_known,
                                  bool covariance_finite);

}  // namespace slamscope::slam
