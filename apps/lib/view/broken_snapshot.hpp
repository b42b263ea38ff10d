// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "slam/snapshot.hpp"

namespace slamscope::apps {

/// Why a snapshot can't be drawn as what it claims to be, in words; nothing for a sound one. What a
/// diverging filter writes: numbers that are not finite, a pose beyond 1e6 m, an asymmetric or an
/// indefinite covariance. (Definiteness by a scaled Cholesky factorisation up to kLargestFactored
/// states, beyond that of each feature's own block: a picture must not wait for O(n³).)
[[nodiscard]] std::optional<std::string> brokenness(const slam::Snapshot& snapshot);

inline constexpr int kLargestFactored = 303;

}  // namespace slamscope::apps
