// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/render/frame_context.hpp"
#include "engine/render/instances.hpp"
#include "engine/render/view_set.hpp"

namespace slamscope::engine {

/// Flat arrows, a shaft and a head. They lie on the floor: drawn under cones and ellipsoids,
/// without depth. One that reaches behind the eye is not drawn.
class ArrowPass {
 public:
  explicit ArrowPass(const PassSetup& setup);

  void update(std::span<const Arrow> arrows, const ViewSet& views, int& not_drawn);
  void record(const FrameContext& context) const;
  /// By instance, as Look::named numbers them.
  [[nodiscard]] std::span<const std::uint64_t> tags() const { return tags_; }

 private:
  Instances instances_;
  Looks looks_;
  std::vector<std::uint64_t> tags_;
};

}  // namespace slamscope::engine
