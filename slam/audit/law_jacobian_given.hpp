// SPDX-License-Identifier: MIT
#pragma once

#include "slam/audit/linearisation.hpp"
#include "slam/audit/outcome.hpp"
#include "slam/audit/transition.hpp"

namespace slamscope::slam {

/// jacobian-given: the H of each observation (level L3) against central differences of the model at
/// the mean before the update, or at the mean after the last prediction (frozen linearisation).
/// Residual: largest difference, of the largest entry. Tolerance 1e-5 + rounding. Needs the sensor.
[[nodiscard]] Outcome checkJacobianGiven(const Transition& transition,
                                         const LinearisationPoints& points, Sensor sensor);

}  // namespace slamscope::slam
