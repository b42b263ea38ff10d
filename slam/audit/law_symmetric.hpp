// SPDX-License-Identifier: MIT
#pragma once

#include "slam/audit/log_precision.hpp"
#include "slam/audit/outcome.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// symmetric: P = Pᵀ. Residual: the worst |P − Pᵀ| of the full matrix that was read, relative to
/// the largest variance. Tolerance 1e-9 for a log of doubles: a filter in double precision that
/// never symmetrises stays some 1e-13 below, one in single precision (6e-8 per operation) does not.
/// In a rounded log two roundings besides. Not checkable where only a triangle was written.
[[nodiscard]] Outcome checkSymmetric(const Snapshot& snapshot, const LogPrecision& precision);

}  // namespace slamscope::slam
