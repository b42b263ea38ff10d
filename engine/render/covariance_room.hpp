// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/gpu/core.hpp"
#include "engine/scene/planar_points.hpp"

namespace slamscope::engine {

/// Why the points' covariance fits no buffer of a device, in a line for people; empty: it does.
[[nodiscard]] std::string lackOfRoom(const gpu::Core& core, const PlanarPoints& points);

}  // namespace slamscope::engine
