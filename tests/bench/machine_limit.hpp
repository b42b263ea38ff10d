// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace slamscope::slam::bench {

/// Wall time of `work`.
[[nodiscard]] double wallSeconds(const std::function<void()>& work);

/// Seconds that the covariance update of kObservations observations needs at least with `features`
/// features: N² m flops on the lower half, or that half read and written once, whichever takes
/// longer, on one thread or two. Measured now.
[[nodiscard]] double machineLimit(int features);

}  // namespace slamscope::slam::bench
