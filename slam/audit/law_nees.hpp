// SPDX-License-Identifier: MIT
#pragma once

#include "slam/audit/outcome.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// nees: normalised estimation error squared against the truth (level L4), of the pose and of each
/// feature, in one record: χ² with 3 and 2 degrees of freedom. Errors of successive records are
/// nearly the same error, so only the newest record is judged. Each of 1 + n blocks gets an equal
/// part of `alpha`; the error is granted a factor 2 in NEES. Linearisation: where all exact laws
/// are whole, this is the EKF's own inconsistency.
[[nodiscard]] Outcome checkNees(const Snapshot& snapshot, double alpha);

}  // namespace slamscope::slam
