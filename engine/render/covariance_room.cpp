// SPDX-License-Identifier: MIT
#include "engine/render/covariance_room.hpp"

namespace slamscope::engine {

std::string lackOfRoom(const gpu::Core& core, const PlanarPoints& points) {
  const std::size_t most = core.limits().maxTexelBufferElements;
  const std::size_t needed = points.blocks().size();
  if (needed <= most) return {};
  return "the covariance of " + std::to_string(points.count()) + " points has " +
         std::to_string(needed) + " blocks, and a buffer of this device no more than " +
         std::to_string(most);
}

}  // namespace slamscope::engine
