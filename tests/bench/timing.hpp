// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

namespace slamscope {

/// Wall time of `work`.
[[nodiscard]] double wallSeconds(const std::function<void()>& work);

/// Median wall time of work(k), k = 1, 2, …, after a work(0) that is not counted: as many as fit
/// into `budget` seconds, 5 at least.
[[nodiscard]] double medianSeconds(const std::function<void(std::size_t)>& work, double budget);

/// Of the machine over the last minute; −1 where the system doesn't tell.
[[nodiscard]] double machineLoad();

}  // namespace slamscope
