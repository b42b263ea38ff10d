// SPDX-License-Identifier: MIT
#pragma once

#include "slam/audit/law_support.hpp"

namespace slamscope::slam {

/// Finds out why `support` is broken, and fills blame, evidence, patterns, `allow` of
/// the anatomy. Patterns that are lawful variants of the filter make the law not checkable.
///
/// D of the lawful rank is an update with another H: another feature's block, or taken at another
/// state, or with another derivative by the heading. D of a larger rank: blocks on the diagonal
/// alone; certain features written outside the update; something besides (a compass).
void diagnoseSupport(const Transition& transition, const LinearisationPoints& points,
                     UpdateAnatomy& anatomy);

}  // namespace slamscope::slam
