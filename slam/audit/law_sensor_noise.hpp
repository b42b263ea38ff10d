// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "slam/audit/innovation_estimate.hpp"
#include "slam/audit/law_support.hpp"
#include "slam/audit/outcome.hpp"
#include "slam/audit/transition.hpp"

namespace slamscope::slam {

/// sensor-noise: R̂ recovered from D (innovation_estimate.hpp) equals the declared R: the header's,
/// or where it has none that of each observation. Needs the sensor. Residual: largest difference,
/// entries scaled by √diag R. Tolerance 1e-4 + what noise may cause; 0.05 where D holds a heading
/// besides: a compass leaves R̂ = R, an observation used twice gives half of it in at least one
/// direction. Patterns: σ given for σ², degrees² for radians², one factor on all of R, used twice.
[[nodiscard]] Outcome checkSensorNoise(const Transition& transition, const UpdateAnatomy& anatomy,
                                       const InnovationEstimate& estimate, const RunHeader& header);

}  // namespace slamscope::slam
