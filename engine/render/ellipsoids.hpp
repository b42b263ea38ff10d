// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/render/frame_context.hpp"
#include "engine/render/instances.hpp"
#include "engine/render/view_set.hpp"
#include "shaders/interop/glyphs.h"

namespace slamscope::engine {

/// All ellipsoids, ray-cast in the fragment shader inside a quad around each outline: exact in
/// perspective, exact depth, exact coverage of edge pixels. One draw for all of them and all views.
/// An ellipsoid that contains the eye is not drawn; flat and needle-like ones are drawn as if no
/// axis were shorter than 1e-4 of the longest (nor 1e-6 of the distance).
class EllipsoidPass {
 public:
  explicit EllipsoidPass(const PassSetup& setup);

  /// Sorts back to front, so that translucent ones and edges blend rightly; the order does not
  /// depend on the order given. Counts those with a number that is not finite in `not_drawn`.
  void update(std::span<const Ellipsoid> ellipsoids, const ViewSet& views, int& not_drawn);
  void record(const FrameContext& context) const;
  /// By instance, as Look::named numbers them.
  [[nodiscard]] std::span<const std::uint64_t> tags() const { return tags_; }

 private:
  Instances instances_;
  Looks looks_;
  std::vector<interop::EllipsoidGlyph> sorted_;
  std::vector<std::uint64_t> tags_;
};

/// The same ellipsoid with orthogonal semi-axes, none of length 0, seen from `distance` m.
[[nodiscard]] Eigen::Matrix3d drawableAxes(const Eigen::Matrix3d& axes, double distance);

}  // namespace slamscope::engine
