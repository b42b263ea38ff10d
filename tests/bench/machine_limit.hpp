// SPDX-License-Identifier: MIT
#pragma once

namespace slamscope::slam::bench {

/// Seconds that the covariance update of kObservations observations needs at least with `features`
/// features: N² m flops on the lower half, or that half read and written once, whichever takes
/// longer, on one thread or two. Measured now.
[[nodiscard]] double machineLimit(int features);

}  // namespace slamscope::slam::bench
