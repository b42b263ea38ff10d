// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/render/frame_context.hpp"
#include "engine/render/instances.hpp"
#include "engine/render/view_set.hpp"
#include "shaders/interop/glyphs.h"

namespace slamscope::engine {

/// Upright cones: exact outline (two straight edges from the tip, tangent to the rim's ellipse) and
/// exact depth. Drawn in two steps around the ellipsoids: the inside with depth before them, the
/// pixels of the edges after them. A cone that reaches behind the eye is not drawn.
class ConePass {
 public:
  explicit ConePass(const PassSetup& setup);

  void update(std::span<const Cone> cones, const ViewSet& views, int& not_drawn);
  void recordInside(const FrameContext& context) const;
  void recordEdges(const FrameContext& context) const;
  /// By instance, as Look::named numbers them.
  [[nodiscard]] std::span<const std::uint64_t> tags() const { return tags_; }

 private:
  Instances instances_;
  Looks inside_, edges_;
  std::vector<std::uint64_t> tags_;
};

}  // namespace slamscope::engine
