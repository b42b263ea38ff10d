// SPDX-License-Identifier: MIT
#pragma once

#include "slam/audit/law_support.hpp"

namespace slamscope::slam {

/// Finds out why `support` is broken, and fills blame, evidence, patterns, `allow` and `nearly` of
/// the anatomy. Patterns that are lawful variants of the filter make the law not checkable.
///
/// In this order: certain features written outside the update; Jacobian taken at another state, or
/// with another derivative by heading; another feature's block of H; something besides (a compass).
void diagnoseSupport(const Transition& transition, const LinearisationPoints& points,
                     UpdateAnatomy& anatomy);

}  // namespace slamscope::slam
